// Puts the reports that the programs of one run of deploy/demo left behind into summary.json, and judges the run.

#include <CLI/CLI.hpp>
#include <iostream>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "files/output_file.hpp"
#include "run_summary.hpp"
#include "version/version.hpp"

namespace {

using namespace pelagos;

constexpr int kOk = 0;
constexpr int kFailed = 1;

void write_summary(const std::filesystem::path& file, const nlohmann::ordered_json& summary) {
  const std::string fault = write_whole_file(file, summary.dump(2) + "\n");
  if (!fault.empty()) throw RunFileError(fault);
}

int run(const std::filesystem::path& folder, const RunFacts& facts) {
  const RunFiles files = read_run(folder);
  const std::vector<std::string> failures = find_failures(files), shortfalls = find_shortfalls(files);
  std::vector<std::string> faults = failures;
  faults.insert(faults.end(), shortfalls.begin(), shortfalls.end());
  const nlohmann::ordered_json summary = summarise(files, facts, faults);
  write_summary(folder / "summary.json", summary);

  std::cout << "\n" << describe(summary);
  for (const std::string& fault : faults) std::cout << "fault      " << fault << "\n";
  if (faults.empty()) std::cout << "faults     none\n";
  std::cout << "\nmade in " << folder.string() << ":\n  summary.json\n";
  for (const PictureFile& picture : files.pictures) {
    std::cout << "  " << picture.name << "  " << picture.width << "x" << picture.height << "\n";
  }
  return failures.empty() ? kOk : kFailed;
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  RunFacts facts;
  CLI::App app("Puts the reports of one run of deploy/demo together into summary.json.", "pelagos-demo-summary");
  app.set_version_flag("--version", std::string("pelagos-demo-summary ") + kVersion);
  app.add_option("--run", folder, "folder of the run")->required()->check(FolderThatExists());
  app.add_option("--scene", facts.scene_file, "scene file that ran")->required();
  app.add_option("--domain", facts.domain, "DDS domain that it ran in")->required();
  app.add_option("--seconds", facts.seconds, "how long it was to run, s")->required();
  app.add_option("--wall-seconds", facts.wall_seconds, "how long it took, s")->required();
  if (const auto status = parse_command_line(app, argc, argv)) return *status;
  try {
    return run(folder, facts);
  } catch (const std::exception& error) {
    std::cerr << "pelagos-demo-summary: " << error.what() << "\n";
    return kFailed;
  }
}
