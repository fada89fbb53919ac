// Lightproof itself, and what its tests look at.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "tests/cli/process.h"
#include "tests/image/picture_files.h"

namespace lightproof::test {

using Words = std::vector<std::string>;

/// The program under test: LIGHTPROOF_UNDER_TEST of the environment, or the one just built.
std::string program();

/// program() with these arguments.
Command lightproof_command(const Words& arguments, const std::filesystem::path& folder = ".");
Finished lightproof(const Words& arguments, const std::filesystem::path& folder = ".");

/// The most memory in kilobytes that the program, or one that it starts, holds at once with these
/// arguments. Not that of Finished, where the system counts what whoever started it ever held.
long peak_kilobytes_of(const Words& arguments);

/// `lightproof gate` with 1024 samples, an 8 x 4 map where it is built in, and these arguments.
Finished quick_gate(const Words& arguments, const std::filesystem::path& folder = ".");

/// Throws nlohmann's exception if it is no JSON.
nlohmann::json json_of(const std::filesystem::path& file);
/// The results that quick_gate writes with these arguments besides --json.
nlohmann::json gate_results(const Words& arguments);

/// The distinct values of a key over all tests of a gate's JSON, in order of first appearance.
Words values_of(const nlohmann::json& gate, const std::string& key);

/// Names in a folder, hidden ones too, sorted.
Words names_in(const std::filesystem::path& folder);
/// Those of them that are left-overs of unfinished files.
Words parts_in(const std::filesystem::path& folder);

/// A map without light-free texels, written as OpenEXR, after `change`.
void write_map(const std::filesystem::path& file, Extent extent = {8, 4},
               const std::function<void(Grid<Rgb>&)>& change = {});

/// The shell script run by root of a private mount namespace, in which `mount -t tmpfs` is
/// possible and invisible to others; "$@" is program() with these arguments.
Command in_mount_namespace(const std::string& script, const Words& arguments,
                           const std::filesystem::path& folder);
/// Whether in_mount_namespace() works here: some containers forbid it.
bool has_mount_namespaces();

}  // namespace lightproof::test
