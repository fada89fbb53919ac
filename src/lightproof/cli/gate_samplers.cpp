#include "gate_samplers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "known_names.h"
#include "lightproof/core/error.h"
#include "lightproof/samplers/registry.h"
#include "lightproof/self_test/direction_mutant.h"
#include "lightproof/self_test/mutant.h"
#include "plugin_options.h"

namespace lightproof::cli {
namespace {

template <class Range>
auto find_named(Range& range, const std::string& name) {
  return std::find_if(range.begin(), range.end(),
                      [&](const auto& item) { return item.name == name; });
}

/// Many samplers of directions by one name.
struct Group {
  std::string name;
  std::vector<DirectionSamplerInfo> (*members)();
};
const std::array<Group, 2> kGroups = {{
    {"directions", direction_samplers},
    {"all_directions", all_direction_samplers},
}};

[[noreturn]] void refuse_unknown(const std::string& name) {
  const std::vector<std::string> of_maps = names_of(samplers());
  std::vector<std::string> of_directions = names_of(direction_samplers());
  for (const Group& group : kGroups) of_directions.push_back(group.name);
  std::vector<std::string> defective = names_of(mutants());
  for (const std::string& mutant : names_of(direction_mutant_samplers())) {
    defective.push_back(mutant);
  }
  std::vector<std::string> all = of_maps;
  for (const auto& more : {of_directions, names_of(all_direction_samplers()), defective}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  throw InputError(
      fmt::format("--sampler: {} (samplers of maps: {}; of directions: {}; mutants: {})",
                  no_such_name("sampler", name, all), listed(of_maps), listed(of_directions),
                  listed(defective)));
}

/// Adds the samplers or mutants of this name. Throws InputError if there are none.
void add_named(ChosenSamplers& chosen, const std::string& name) {
  for (const Group& group : kGroups) {
    if (group.name != name) continue;
    for (DirectionSamplerInfo& member : group.members()) {
      chosen.of_directions.push_back(std::move(member));
    }
    return;
  }
  for (std::vector<DirectionSamplerInfo> all :
       {all_direction_samplers(), direction_mutant_samplers()}) {
    const auto found = find_named(all, name);
    if (found == all.end()) continue;
    chosen.of_directions.push_back(std::move(*found));
    return;
  }
  const std::span<const Mutant> all_mutants = mutants();
  const std::span<const SamplerInfo> all_samplers = samplers();
  const auto mutant = find_named(all_mutants, name);
  const auto sampler = find_named(all_samplers, name);
  if (mutant == all_mutants.end() && sampler == all_samplers.end()) refuse_unknown(name);
  for (const DensityInfo& density : kDensities) {
    chosen.of_maps.push_back(mutant != all_mutants.end()
                                 ? sampler_under_test(*mutant, density.density_space)
                                 : sampler_under_test(*sampler, density.density_space));
  }
}

/// Throws InputError if samplers of directions, by these names, were named together with maps or a
/// density, which they have no use for.
void settle_named_directions(const SamplerChoice& choice, const std::vector<std::string>& given,
                             ChosenSamplers& chosen) {
  if (given.empty()) return;
  const std::string names = listed(given);
  if (!choice.density_space.empty()) {
    const std::string reason =
        fmt::format("--density: {} draws directions, which have no density of a map", names);
    if (chosen.of_maps.empty()) throw InputError(reason + ": leave the option out");
    chosen.notes.push_back(reason + ": left out");
    chosen.of_directions.clear();
    return;
  }
  if (!choice.has_maps) return;
  const std::string reason = fmt::format("--sampler: {} draws directions and needs no map", names);
  if (chosen.of_maps.empty()) {
    throw InputError(reason + ": leave the maps out, or name a sampler of maps as well");
  }
  chosen.notes.push_back(reason + ": tested once, without one");
}

/// Leaves out what stands in the list before, by key(item).
template <class Item, class Key>
void drop_repeated(std::vector<Item>& items, const Key& key) {
  std::set<std::string> seen;
  std::erase_if(items, [&](const Item& item) { return !seen.insert(key(item)).second; });
}

/// Throws InputError if a density was asked for that a plug-in does not declare.
void refuse_other_density(const SamplerChoice& choice) {
  if (choice.density_space.empty()) return;
  for (const SamplerUnderTest& plugin : choice.plugins) {
    const std::string declared(to_string(plugin.target.density_space));
    if (declared == choice.density_space) continue;
    throw InputError(fmt::format("--density: {} declares density {}, not {}: leave out one of both",
                                 plugin.name, declared, choice.density_space));
  }
}

}  // namespace

ChosenSamplers choose_samplers(const SamplerChoice& choice) {
  ChosenSamplers chosen;
  std::vector<std::string> names_of_directions;
  for (const std::string& name : choice.names) {
    const std::size_t before = chosen.of_directions.size();
    add_named(chosen, name);
    if (chosen.of_directions.size() > before) names_of_directions.push_back(name);
  }
  // A name that is given twice, or in a group as well, is tested once.
  drop_repeated(chosen.of_maps, [](const SamplerUnderTest& under_test) {
    return fmt::format("{} {}", under_test.name, to_string(under_test.target.density_space));
  });
  drop_repeated(chosen.of_directions,
                [](const DirectionSamplerInfo& sampler) { return sampler.name; });
  settle_named_directions(choice, names_of_directions, chosen);
  refuse_other_density(choice);
  add_plugins(choice.plugins, chosen.of_maps);
  if (choice.names.empty() && choice.plugins.empty()) {
    chosen.of_maps = all_samplers_under_test();
    if (!choice.with_published) {
      std::erase_if(chosen.of_maps,
                    [](const SamplerUnderTest& under_test) { return under_test.known_defects; });
    }
    const bool of_directions = !choice.has_maps && choice.density_space.empty();
    if (of_directions) chosen.of_directions = direction_samplers();
  }
  std::erase_if(chosen.of_maps, [&](const SamplerUnderTest& under_test) {
    return !choice.density_space.empty() &&
           choice.density_space != to_string(under_test.target.density_space);
  });
  return chosen;
}

}  // namespace lightproof::cli
