// camber cite: the papers behind what is computed.
#include <memory>

#include <nlohmann/json.hpp>

#include "console.hpp"
#include "output.hpp"
#include "references.hpp"
#include "verbs.hpp"

namespace camber::app {

Verb add_cite(CLI::App& app) {
  const auto flags = std::make_shared<CommonFlags>();
  CLI::App* verb = app.add_subcommand("cite", "the papers behind what camber does, as BibTeX");
  add_common_flags(*verb, *flags);
  const auto run = [flags] {
    if (!flags->is_quiet) print(k_references);
    if (!flags->json.empty()) {
      const nlohmann::ordered_json json{
          {"command", "cite"}, {"status", "ok"}, {"exit_code", 0}, {"bibtex", k_references}};
      io::write_text(flags->json, json.dump(2) + "\n");
    }
    return 0;
  };
  return {verb, flags.get(), run};
}

}  // namespace camber::app
