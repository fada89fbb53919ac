// Lists from which a reader chooses what a chart shows: a map, a receiver, a material.
#pragma once

#include <string>
#include <vector>

#include "lightproof/page/chart_parts.h"

namespace lightproof {

/// One of the lists: the field of a chart's rows that it chooses by, and what stands before it.
struct ChoiceList {
  std::string field;
  std::string label;
};

/// The scene that a chart shows at a time, as map, receiver and material: an entry for each list.
using SceneKey = std::vector<std::string>;

/// A list for each of the fields if there is every combination of their entries; else one list of
/// whole scenes.
class SceneChoice {
 public:
  /// `scenes` is not empty, each has an entry for each list; `first` is the one shown at first.
  SceneChoice(std::vector<ChoiceList> lists, const std::vector<SceneKey>& scenes,
              const SceneKey& first);

  /// The parameters of a Vega-Lite chart that bring the lists.
  Json params() const;
  /// The transform that leaves the rows of the chosen scene.
  Json filter() const;
  /// Says of a row where it belongs.
  void put(Json& row, const SceneKey& scene) const;
  /// What the page's script makes of the entries that are chosen: "city | sphere".
  std::string key(const SceneKey& scene) const;

 private:
  SceneKey entries(const SceneKey& scene) const;

  std::vector<ChoiceList> lists_;
  std::vector<std::vector<std::string>> options_;  ///< a list each
  SceneKey first_;
  bool is_whole_ = false;  ///< whether one list has whole scenes
};

}  // namespace lightproof
