// Pictures by a published form and its correction, beside the exact one.
#pragma once

#include <string>
#include <tuple>

#include "lightproof/core/direction.h"
#include "lightproof/core/grid.h"

namespace lightproof {

/// A picture three times, of one size, row 0 at the top.
struct PublishedPicture {
  std::string system;          ///< its number in the list of systems: "002-6"
  std::string what;            ///< what is shown, in one line
  std::string published_form;  ///< what differs, in one line
  std::string corrected_form;
  std::string exact_form;  ///< how the exact picture was made
  Grid<Rgb> exact;         ///< linear radiance
  Grid<Rgb> published;
  Grid<Rgb> corrected;
  /// Signed, in luminance over the mean luminance of the exact picture's own pixels; 0 where the
  /// picture shows only the surroundings.
  Grid<double> published_error;
  Grid<double> corrected_error;
  double published_rmse = 0.0;  ///< root mean square of the error over the picture's own pixels
  double corrected_rmse = 0.0;
  double noise = 0.0;  ///< root mean square standard error of the exact picture, on the same scale

  static auto fields(auto& all) {
    return std::tie(all.system, all.what, all.published_form, all.corrected_form, all.exact_form,
                    all.exact, all.published, all.corrected, all.published_error,
                    all.corrected_error, all.published_rmse, all.corrected_rmse, all.noise);
  }
};

}  // namespace lightproof
