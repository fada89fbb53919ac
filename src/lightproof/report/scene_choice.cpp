#include "lightproof/report/scene_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace lightproof {
namespace {

/// A combination of all lists, as one entry.
std::string joined(const SceneKey& scene) { return fmt::format("{}", fmt::join(scene, ", ")); }

std::string label_of(const std::vector<ChoiceList>& lists) {
  SceneKey labels;
  for (const ChoiceList& list : lists) labels.push_back(list.label);
  return joined(labels);
}

std::vector<std::string> options_of(const std::vector<SceneKey>& scenes, std::size_t list) {
  std::vector<std::string> names;
  for (const SceneKey& scene : scenes) names.push_back(scene[list]);
  return unique_names(names);
}

std::vector<std::string> whole_scenes(const std::vector<SceneKey>& scenes) {
  std::vector<std::string> names;
  for (const SceneKey& scene : scenes) names.push_back(joined(scene));
  return unique_names(names);
}

}  // namespace

SceneChoice::SceneChoice(std::vector<ChoiceList> lists, const std::vector<SceneKey>& scenes,
                         const SceneKey& first)
    : lists_(std::move(lists)), first_(first) {
  std::size_t combinations = 1;
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    options_.push_back(options_of(scenes, i));
    combinations *= options_.back().size();
  }
  const std::vector<std::string> whole = whole_scenes(scenes);
  is_whole_ = whole.size() != combinations;
  if (!is_whole_) return;
  lists_ = {{"scene", label_of(lists_)}};
  options_ = {whole};
}

SceneKey SceneChoice::entries(const SceneKey& scene) const {
  return is_whole_ ? SceneKey{joined(scene)} : scene;
}

Json SceneChoice::params() const {
  const SceneKey chosen = entries(first_);
  Json params = Json::array();
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    params.push_back(
        {{"name", "chosen_" + lists_[i].field},
         {"value", chosen[i]},
         {"bind", {{"input", "select"}, {"options", options_[i]}, {"name", lists_[i].label}}}});
  }
  return params;
}

Json SceneChoice::filter() const {
  std::string test;
  for (const ChoiceList& list : lists_) {
    test +=
        fmt::format("{}datum.{} === chosen_{}", test.empty() ? "" : " && ", list.field, list.field);
  }
  return {{"filter", test}};
}

void SceneChoice::put(Json& row, const SceneKey& scene) const {
  const SceneKey chosen = entries(scene);
  for (std::size_t i = 0; i < lists_.size(); ++i) row[lists_[i].field] = chosen[i];
}

std::string SceneChoice::key(const SceneKey& scene) const {
  return fmt::format("{}", fmt::join(entries(scene), " | "));
}

}  // namespace lightproof
