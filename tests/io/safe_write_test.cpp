// The promise of write_mesh: either the new file is complete and checked, or the old one is
// untouched.
#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>

#include <csignal>
#include <filesystem>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(WriteMesh, ReplacesAnOldFileAndLeavesNothingElse) {
  const std::string path = scratch("mesh.msh");
  spill(path, "old");

  write_mesh(zoo(), path);

  EXPECT_EQ(read_mesh(path).element_count(), zoo().element_count());
  EXPECT_EQ(files_in(folder_of(path)), 1U);
}

TEST(WriteMesh, GivesVerifyWhatIsOnTheDisk) {
  const std::string path = scratch("mesh.msh");
  MeshData seen;

  write_mesh(zoo(), path, {}, [&](const MeshData& read) {
    EXPECT_FALSE(fs::exists(path)) << "verified before it takes its place";
    seen = read;
  });

  EXPECT_EQ(seen.source, path);
  expect_same_mesh(zoo(), seen, true);
}

TEST(WriteMesh, LeavesTheOldFileWhenVerifyRefuses) {
  const std::string path = scratch("mesh.msh");
  spill(path, "old");

  const std::string message = message_of([&] {
    write_mesh(zoo(), path, {}, [](const MeshData&) { throw FileError("not good", "here", ""); });
  });

  EXPECT_EQ(message, "here: not good");
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(files_in(folder_of(path)), 1U);
}

TEST(WriteAtomically, RemovesTheTemporaryWhateverIsThrown) {
  const std::string path = scratch("file.txt");
  spill(path, "old");
  std::string temporary;

  EXPECT_THROW(write_atomically(path,
                                [&](const std::string& name) {
                                  temporary = name;
                                  spill(name, "half");
                                  throw std::runtime_error("stopped");
                                }),
               std::runtime_error);

  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(files_in(folder_of(path)), 1U);
  EXPECT_EQ(folder_of(temporary), folder_of(path)) << "a rename must not cross file systems";
  const std::string name = fs::path(temporary).filename().string();
  EXPECT_EQ(name.substr(0, 10), ".file.txt.");
  EXPECT_EQ(name.size(), 10U + 6U + 4U);
  EXPECT_EQ(name.substr(16), ".tmp");
}

TEST(WriteAtomically, KeepsPermissionsAndFollowsLinks) {
  const std::string path = scratch("real.txt");
  const std::string link = scratch("link.txt");
  spill(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  fs::create_symlink(path, link);

  write_atomically(link, [](const std::string& name) { spill(name, "new"); });

  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(slurp(path), "new");
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(WriteAtomically, TakesTheLongestNames) {
  const std::string path = scratch(std::string(251, 'n') + ".txt");

  write_atomically(path, [](const std::string& name) { spill(name, "new"); });

  EXPECT_EQ(slurp(path), "new");
}

TEST(CheckWritable, NamesEveryReasonAtOnce) {
  fs::create_directory(scratch("folder.msh"));
  spill(scratch("file"), "x");
  fs::create_symlink(scratch("nowhere.msh"), scratch("dangling.msh"));
  const auto message = [](const std::string& path, const WriteOptions& options = {}) {
    return message_of([&] { check_writable(path, options); });
  };

  EXPECT_NO_THROW(check_writable(scratch("new.msh")));
  EXPECT_NO_THROW(check_writable(scratch("new.VTU")));
  EXPECT_NO_THROW(check_writable(scratch("new.dat"), {.format = Format::gmsh}));
  EXPECT_NE(message("").find("no extension"), std::string::npos);
  EXPECT_NE(message(scratch("new.obj")).find("unknown extension '.obj'"), std::string::npos);
  EXPECT_NE(message(scratch("folder.msh")).find("is a folder"), std::string::npos);
  EXPECT_NE(message(scratch("none/new.msh")).find("create the folder"), std::string::npos);
  EXPECT_NE(message(scratch("file/new.msh")).find("file is not a folder"), std::string::npos);
  EXPECT_NE(message(scratch("dangling.msh")).find("a link to nothing"), std::string::npos);
  EXPECT_NE(message("/dev/null", {.format = Format::gmsh}).find("a device"), std::string::npos);
  EXPECT_NE(message(scratch(std::string(300, 'n') + ".msh")).find("File name too long"),
            std::string::npos);
  EXPECT_NE(message(scratch("new.msh"), {.gmsh_version = 4.0}).find("choose version 4.1 or 2.2"),
            std::string::npos);
  // None of these questions left anything behind.
  EXPECT_EQ(files_in(folder_of(scratch("x"))), 3U);
}

TEST(CheckWritable, WriteMeshEndsInTheSameError) {
  for (const std::string& path : {scratch("a.obj"), scratch("none/a.msh"), scratch("none/a.vtu")}) {
    EXPECT_EQ(message_of([&] { check_writable(path); }),
              message_of([&] { write_mesh(zoo(), path); }));
  }
}

/// Runs `action` in a child process; the result is its exit code. Limits, users and mounts of the
/// child do not concern the other tests.
template <class Action>
int in_child(const Action& action) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(action());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CheckWritable, NamesFoldersWithoutPermission) {
  const std::string folder = scratch("locked");
  fs::create_directory(folder);
  ASSERT_EQ(::chmod(folder.c_str(), 0555), 0);

  const int code = in_child([&] {
    // The super-user may write everywhere: become somebody else.
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return 77;
    if (::access(folder_of(folder).c_str(), X_OK) != 0) return 77;
    const std::string message = message_of([&] { check_writable(folder + "/mesh.msh"); });
    return message.find("Permission denied") != std::string::npos ? 0 : 1;
  });

  if (code == 77) GTEST_SKIP() << "cannot become another user";
  EXPECT_EQ(code, 0);
}

/// A mesh that every format takes but the linear ones, and of which no file is small.
MeshData conforming_mesh() { return hybrid(4, 1); }

/// Writes under a limit of the file size: the system refuses as on a full disk.
class FullDisk : public testing::TestWithParam<const char*> {};

TEST_P(FullDisk, ALimitOfTheFileSizeLeavesTheOldFile) {
  const std::string path = scratch(GetParam());
  spill(path, "old");

  const int code = in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 77;
    const std::string message = message_of([&] { write_mesh(conforming_mesh(), path); });
    return message.find(path + ": cannot be written: File too large") == 0 ? 0 : 1;
  });

  if (code == 77) GTEST_SKIP() << "cannot set a limit";
  EXPECT_EQ(code, 0);
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(files_in(folder_of(path)), 1U);
}

TEST_P(FullDisk, NoSpaceLeftLeavesTheOldFile) {
  const std::string folder = scratch("disk");
  fs::create_directory(folder);
  if (::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=16k") != 0) {
    GTEST_SKIP() << "cannot mount a small disk";
  }
  const std::string path = folder + "/" + GetParam();
  spill(path, "old");

  const std::string message = message_of([&] { write_mesh(conforming_mesh(), path); });
  const std::string left = slurp(path);
  const std::size_t files = files_in(folder);
  ::umount2(folder.c_str(), MNT_DETACH);

  EXPECT_NE(message.find("cannot be written: No space left on device"), std::string::npos)
      << message;
  EXPECT_NE(message.find("free some disk space"), std::string::npos);
  EXPECT_EQ(left, "old");
  EXPECT_EQ(files, 1U);
}

INSTANTIATE_TEST_SUITE_P(Formats, FullDisk,
                         testing::Values("mesh.msh", "mesh.vtu", "mesh.mesh", "mesh.xml", "mesh.h5",
                                         "mesh.su2"),
                         [](const auto& p) { return std::string(p.param).substr(5); });

}  // namespace
}  // namespace camber::io
