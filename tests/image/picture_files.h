// Picture files for the reader's tests, written with OpenEXR itself or byte by byte, so that a
// mistake in the reader cannot cancel the same mistake in the writer.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"
#include "lightproof/core/temporary_folder.h"

namespace lightproof::test {

using lightproof::TemporaryFolder;

enum class Envmap { lat_long, cube };

struct ExrOptions {
  std::vector<std::string> channels = {"R", "G", "B"};
  std::optional<Envmap> envmap = std::nullopt;
  bool bottom_row_first = false;
  /// Lower corner of both windows.
  int origin_x = 0;
  int origin_y = 0;
  /// The display window is larger than the data window by this many columns; smaller if negative.
  int missing_columns = 0;
  bool xyz = false;
  /// Red, green, blue and white, x and y of each.
  std::optional<std::array<float, 8>> chromaticities = std::nullopt;
  float pixel_aspect = 1.0F;
  /// Side of tiles of which the header speaks, though the file is of lines.
  std::optional<unsigned> tiles_of_lines = std::nullopt;
};

/// 32-bit float scanlines; row 0 of the picture at the top. Channels beyond three hold 0.
void write_exr_file(const std::filesystem::path& file, const Grid<Rgb>& picture,
                    const ExrOptions& options = {});
/// How OpenEXR files are compressed, in the order of the format's numbers.
inline constexpr std::array<std::string_view, 10> kExrCompressions = {
    "none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
/// The picture as lines, or as tiles of this side, compressed in one of these ways, of 16-bit or
/// 32-bit floats.
void write_compressed_exr(const std::filesystem::path& file, const Grid<Rgb>& picture,
                          std::size_t compression, bool is_half, unsigned tile = 0);
void write_uint_exr(const std::filesystem::path& file, Extent extent);
void write_two_part_exr(const std::filesystem::path& file, const Grid<Rgb>& first,
                        const Grid<Rgb>& second);
void write_deep_exr(const std::filesystem::path& file, Extent extent);
void write_luminance_chroma_exr(const std::filesystem::path& file, Extent extent);

/// One RGBE pixel.
struct Rgbe {
  unsigned char r, g, b, exponent;
};

/// Uncompressed Radiance .hdr, `resolution` as in "-Y 2 +X 4", pixels in the order stored.
void write_hdr_file(const std::filesystem::path& file, const std::string& resolution,
                    const std::vector<Rgbe>& pixels, const std::string& header_lines = "");

/// An integer picture through OpenImageIO: the format by extension, values of 8 or 16 bits.
void write_integer_picture(const std::filesystem::path& file, Extent extent, int channels,
                           const std::vector<unsigned>& values, int bits, int orientation = 1);

/// An 8-bit PNG with a gAMA chunk: samples are in proportion to light^`gamma`.
void write_png_with_gamma(const std::filesystem::path& file, Extent extent,
                          const std::vector<unsigned>& values, double gamma);

std::string bytes_of(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

/// Every value of the picture different, positive, and of few bits.
Grid<Rgb> numbered_picture(Extent extent);

}  // namespace lightproof::test
