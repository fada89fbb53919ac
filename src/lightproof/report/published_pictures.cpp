#include "lightproof/report/published_pictures.h"

#include <fmt/format.h>

#include <array>

#include "lightproof/page/html.h"
#include "lightproof/page/numbers.h"
#include "lightproof/report/picture_html.h"
#include "lightproof/report/pictures.h"

namespace lightproof {
namespace {

constexpr std::string_view kNote =
    "Above: the picture, exposed so that the exact one's mean luminance is 0.35, clipped and "
    "sRGB-encoded. Below: picture minus exact picture in luminance, relative to the exact one's "
    "mean over what is shaded; at most 1\u00a0% of the differences lie beyond the ends of the "
    "colours.";

/// A picture by one form.
struct Form {
  std::string_view name;
  const std::string& text;
  const Grid<Rgb>& picture;
  const Grid<double>& error;
  double rmse;
};

std::string form_figure(const Form& form, double scale, double range) {
  return fmt::format(
      "<figure>{}\n{}\n<figcaption><strong>{}</strong>: {}<br>RMS difference / mean "
      "{}</figcaption></figure>\n",
      image_html(tone_mapped(form.picture, scale), fmt::format("Picture, {}", form.name)),
      image_html(
          diverging_picture(form.error, range),
          fmt::format("Signed difference of the {} picture, from blue (too dark) to red (too "
                      "bright)",
                      form.name)),
      escaped(form.name), escaped(form.text), percent(form.rmse));
}

std::string noise_text(const PublishedPicture& picture) {
  if (!(picture.noise > 0.0)) return "";
  return fmt::format("<br>its noise, which counts in both differences: {}", percent(picture.noise));
}

std::string picture_html(const PublishedPicture& picture) {
  const double scale = mean_exposure(picture.exact);
  const std::array<const Grid<double>*, 2> errors = {&picture.published_error,
                                                     &picture.corrected_error};
  const double range = common_range(errors);
  std::string html = fmt::format(
      "<h3>{}: the published form is off by {}, the corrected one by {}</h3>\n",
      escaped(picture.system), percent(picture.published_rmse), percent(picture.corrected_rmse));
  html += paragraph(fmt::format("Shown is {}.", picture.what));
  html += fmt::format(
      "<div class=\"renders three\">\n<figure>{}\n{}<figcaption><strong>exact</strong>: {}{}"
      "</figcaption></figure>\n",
      image_html(tone_mapped(picture.exact, scale), "Exact picture"), colour_bar_html(range),
      escaped(picture.exact_form), noise_text(picture));
  html += form_figure({"published", picture.published_form, picture.published,
                       picture.published_error, picture.published_rmse},
                      scale, range);
  html += form_figure({"corrected", picture.corrected_form, picture.corrected,
                       picture.corrected_error, picture.corrected_rmse},
                      scale, range);
  return html + "</div>\n";
}

}  // namespace

std::string published_pictures_html(const std::vector<PublishedPicture>& pictures) {
  if (pictures.empty()) return "";
  std::string html = paragraph(kNote, "note");
  for (const PublishedPicture& picture : pictures) html += picture_html(picture);
  return html;
}

}  // namespace lightproof
