#include "lightproof/report/place_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace lightproof {
namespace {

/// A combination of all lists, as one entry.
std::string joined(const Place& place) { return fmt::format("{}", fmt::join(place, ", ")); }

std::string label_of(const std::vector<ChoiceList>& lists) {
  Place labels;
  for (const ChoiceList& list : lists) labels.push_back(list.label);
  return joined(labels);
}

std::vector<std::string> options_of(const std::vector<Place>& places, std::size_t list) {
  std::vector<std::string> names;
  for (const Place& place : places) names.push_back(place[list]);
  return unique_names(names);
}

std::vector<std::string> whole_places(const std::vector<Place>& places) {
  std::vector<std::string> names;
  for (const Place& place : places) names.push_back(joined(place));
  return unique_names(names);
}

}  // namespace

PlaceChoice::PlaceChoice(std::vector<ChoiceList> lists, const std::vector<Place>& places,
                         const Place& first)
    : lists_(std::move(lists)), first_(first) {
  std::size_t combinations = 1;
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    options_.push_back(options_of(places, i));
    combinations *= options_.back().size();
  }
  const std::vector<std::string> whole = whole_places(places);
  is_whole_ = whole.size() != combinations;
  if (!is_whole_) return;
  lists_ = {{"place", label_of(lists_)}};
  options_ = {whole};
}

Place PlaceChoice::entries(const Place& place) const {
  return is_whole_ ? Place{joined(place)} : place;
}

Json PlaceChoice::params() const {
  const Place chosen = entries(first_);
  Json params = Json::array();
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    params.push_back(
        {{"name", "chosen_" + lists_[i].field},
         {"value", chosen[i]},
         {"bind", {{"input", "select"}, {"options", options_[i]}, {"name", lists_[i].label}}}});
  }
  return params;
}

Json PlaceChoice::filter() const {
  std::string test;
  for (const ChoiceList& list : lists_) {
    test +=
        fmt::format("{}datum.{} === chosen_{}", test.empty() ? "" : " && ", list.field, list.field);
  }
  return {{"filter", test}};
}

void PlaceChoice::put(Json& row, const Place& place) const {
  const Place chosen = entries(place);
  for (std::size_t i = 0; i < lists_.size(); ++i) row[lists_[i].field] = chosen[i];
}

std::string PlaceChoice::key(const Place& place) const {
  return fmt::format("{}", fmt::join(entries(place), " | "));
}

}  // namespace lightproof
