#include "tests/cli/program.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

namespace lightproof::test {
namespace fs = std::filesystem;

std::string program() {
  const char* other = std::getenv("LIGHTPROOF_UNDER_TEST");
  return other != nullptr ? other : LIGHTPROOF_PROGRAM;
}

namespace {

/// What a study keeps stays in the build's folder.
std::vector<std::string> own_cache() {
  const fs::path kept = fs::path(LIGHTPROOF_PROGRAM).parent_path() / "kept-by-tests";
  return {"LIGHTPROOF_CACHE=" + kept.string()};
}

}  // namespace

Command lightproof_command(const Words& arguments, const fs::path& folder) {
  Command command{.words = {program()}, .folder = folder, .environment = own_cache()};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  return command;
}

Finished lightproof(const Words& arguments, const fs::path& folder) {
  return run(lightproof_command(arguments, folder));
}

long peak_kilobytes_of(const Words& arguments) {
  constexpr const char* kScript =
      "import resource, subprocess, sys\n"
      "nowhere = subprocess.DEVNULL\n"
      "subprocess.run(sys.argv[1:], stdout=nowhere, stderr=nowhere)\n"
      "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)\n";
  Command command = lightproof_command(arguments);
  command.words.insert(command.words.begin(), {LIGHTPROOF_PYTHON, "-c", kScript});
  return std::stol(run(command).out);
}

Finished quick_gate(const Words& arguments, const fs::path& folder) {
  Words all = {"gate", "-n", "1024", "--must-detect", "10", "--size", "8x4"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return lightproof(all, folder);
}

nlohmann::json json_of(const fs::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

nlohmann::json gate_results(const Words& arguments) {
  const TemporaryFolder folder;
  Words all = arguments;
  all.insert(all.end(), {"--json", (folder / "results.json").string()});
  quick_gate(all);
  return json_of(folder / "results.json");
}

Words values_of(const nlohmann::json& gate, const std::string& key) {
  Words values;
  for (const auto& test : gate.at("tests")) {
    const std::string value = test.at(key);
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

Words names_in(const fs::path& folder) {
  Words names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

Words parts_in(const fs::path& folder) {
  Words names = names_in(folder);
  std::erase_if(names,
                [](const std::string& name) { return name.find(".part") == std::string::npos; });
  return names;
}

void write_map(const fs::path& file, Extent extent, const std::function<void(Grid<Rgb>&)>& change) {
  Grid<Rgb> picture = numbered_picture(extent);
  if (change) change(picture);
  write_exr_file(file, picture);
}

Command in_mount_namespace(const std::string& script, const Words& arguments,
                           const fs::path& folder) {
  Command command{
      .words = {"unshare", geteuid() == 0 ? "-m" : "-rm", "sh", "-c", script, "sh", program()},
      .folder = folder,
      .environment = own_cache()};
  command.words.insert(command.words.end(), arguments.begin(), arguments.end());
  return command;
}

bool has_mount_namespaces() {
  const TemporaryFolder folder;
  try {
    return run(in_mount_namespace("mount -t tmpfs none .", {}, folder / "")).exit_code == 0;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace lightproof::test
