// Files that are damaged as files get damaged, or as somebody damages them who means harm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lightproof::test {

struct DamagedFile {
  std::string name;  ///< of the kind of file and the number of the damage
  std::string bytes;
};

/// Files of every compression of OpenEXR, in lines and in tiles, of every coding of Radiance
/// pictures, and of a PNG and a JPEG picture: `each` of a kind with one to eight damages (bytes and
/// bits changed, numbers made huge, pieces cut out, copied or doubled, the end cut off). The same
/// seed gives the same files.
std::vector<DamagedFile> damaged_files(const std::filesystem::path& folder, std::uint64_t each,
                                       std::uint64_t seed);

}  // namespace lightproof::test
