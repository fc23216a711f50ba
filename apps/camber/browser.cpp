#include "browser.hpp"

#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <signal.h>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "console.hpp"

namespace camber::app {
namespace {

namespace fs = std::filesystem;

constexpr int k_patience_s = 120;
constexpr int k_smallest_picture = 100, k_largest_picture = 8192;  // [pixels]

bool is_program(const fs::path& path) {
  return fs::is_regular_file(path) && access(path.c_str(), X_OK) == 0;
}

/// A folder that is gone at the end: the browser's profile, so that a browser in use is left alone.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "camber-browser-XXXXXX").string();
    if (!mkdtemp(name.data())) {
      throw FileError("no folder can be made for the browser's files", name,
                      "set TMPDIR to a folder that can be written");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;  // a browser that is still ending may write once more
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// file:// address: everything but the plainest characters as %XX.
std::string file_address(const fs::path& path) {
  std::string address = "file://";
  for (char c : fs::absolute(path).string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '/' || c == '-' || c == '_' || c == '.';
    address += is_plain
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return address;
}

/// Runs a program in its own process group; what it prints goes to a file. @return its exit status,
/// or -1 if it was ended for taking too long
int run_quietly(const std::vector<std::string>& command, const fs::path& output) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, output.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = 0;
  const int error = posix_spawn(&process, command.front().c_str(), &files, &attributes,
                                arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) return 127;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(k_patience_s);
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline || interrupted() != 0) {
      kill(-process, SIGKILL);
      waitpid(process, &status, 0);
      stop_if_interrupted();
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

PictureSize picture_size(const std::string& text) {
  PictureSize size;
  char x = 0, rest = 0;
  std::istringstream in(text);
  const bool is_read = (in >> size.width >> x >> size.height) && !(in >> rest) && x == 'x';
  const auto fits = [](int n) { return n >= k_smallest_picture && n <= k_largest_picture; };
  if (!is_read || !fits(size.width) || !fits(size.height)) {
    throw OptionError("'" + text + "' is no size of a picture", "--size",
                      fmt::format("give WIDTHxHEIGHT, each {} to {} pixels, as in 1600x1000",
                                  k_smallest_picture, k_largest_picture));
  }
  return size;
}

std::string find_browser() {
  if (const char* given = std::getenv("CAMBER_BROWSER"); given && *given) {
    if (is_program(given)) return given;
    throw OptionError(fmt::format("the browser {} is no program", given), "CAMBER_BROWSER",
                      "set it to the path of Chromium or Chrome");
  }
  const char* path = std::getenv("PATH");
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "chrome"}) {
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
      if (is_program(fs::path(folder) / name)) return (fs::path(folder) / name).string();
    }
  }
  throw OptionError("pictures are made by Chromium or Chrome, and there is none", "--png",
                    "install it (apt install chromium), or set CAMBER_BROWSER to its path; a page "
                    "(-o) needs no browser to be written");
}

void take_picture(const std::string& browser, const std::string& page, const std::string& state,
                  const PictureSize& size, const std::string& png) {
  const TemporaryFolder folder;
  const fs::path shot = folder.path() / "picture.png";
  std::vector<std::string> command{browser,
                                   "--headless",
                                   "--use-angle=swiftshader",
                                   "--enable-unsafe-swiftshader",
                                   "--hide-scrollbars",
                                   "--no-first-run",
                                   "--force-device-scale-factor=1",
                                   "--user-data-dir=" + (folder.path() / "profile").string(),
                                   fmt::format("--window-size={},{}", size.width, size.height),
                                   "--screenshot=" + shot.string(),
                                   "--dump-dom"};
  // Chromium refuses to run as root inside its sandbox; the page is our own and loads nothing.
  if (geteuid() == 0) command.emplace_back("--no-sandbox");
  command.push_back(file_address(page) + "#picture=1&" + state);
  const fs::path shown = folder.path() / "shown.html";
  const int status = run_quietly(command, shown);
  if (status != 0 || !fs::exists(shot) || fs::file_size(shot) == 0) {
    throw FileError(
        status == -1 ? fmt::format("{} took over {} s to draw the picture", browser, k_patience_s)
                     : fmt::format("{} made no picture (exit code {})", browser, status),
        png, "open the page (-o PAGE.html) in a browser instead");
  }
  // The page itself says whether it could draw what was asked for.
  const std::string text = read_all(shown);
  const std::size_t body = text.find("<body");
  const std::string state_of_page =
      body == std::string::npos ? "" : text.substr(body, text.find('>', body) - body);
  if (state_of_page.find("data-ready=\"1\"") == std::string::npos ||
      state_of_page.find("data-errors") != std::string::npos) {
    throw FileError(fmt::format("the page could not be drawn by {}", browser), png,
                    "open the page (-o PAGE.html) in a browser: it says what is wrong");
  }
  io::write_atomically(png, [&](const std::string& temporary) {
    std::ifstream in(shot, std::ios::binary);
    std::ofstream out(temporary, std::ios::binary);
    out << in.rdbuf();
    out.close();
    if (!out) throw FileError("cannot be written", png, "check that the disk is not full");
  });
}

}  // namespace camber::app
