#include "lightproof/image/map_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>

#include "lightproof/core/error.h"
#include "lightproof/core/heap.h"
#include "lightproof/image/map_identity.h"

namespace lightproof {
namespace {

struct Entry {
  std::string source;
  std::size_t texels;
  std::function<EnvironmentMap()> read_again;
  std::mutex reading;
  std::weak_ptr<const EnvironmentMap> map;
  std::string identity;  ///< of a map that is not kept any more
};

std::string user_name_of(const EnvironmentMap& map) {
  return map.source.empty() ? map.name : map.source;
}

MapSource described(const EnvironmentMap& map) {
  return {map.name, map.source, map.radiance.extent(), map.mapping, map.weights, {}};
}

}  // namespace

std::vector<MapSource> sources_of(std::span<const EnvironmentMap> maps) {
  std::vector<MapSource> sources;
  for (const EnvironmentMap& map : maps) {
    sources.push_back(described(map));
    // Shares nothing: whoever owns the map keeps it.
    sources.back().load = [&map] {
      return std::shared_ptr<const EnvironmentMap>(std::shared_ptr<void>(), &map);
    };
  }
  return sources;
}

struct MapStore::State {
  struct Kept {
    std::shared_ptr<Entry> entry;
    std::shared_ptr<const EnvironmentMap> map;
  };

  explicit State(std::size_t texels) : most_texels(texels) {}

  /// Lets go of what was asked for longest ago, until so many texels fit in or nothing is left.
  void make_room(std::size_t texels) {
    const std::lock_guard lock(mutex);
    const bool is_full = !kept.empty() && kept_texels + texels > most_texels;
    while (!kept.empty() && kept_texels + texels > most_texels) {
      const Kept& last = kept.back();
      if (last.entry->identity.empty()) last.entry->identity = identity_of(*last.map);
      kept_texels -= last.entry->texels;
      kept.pop_back();
    }
    if (is_full) give_back_freed_memory();
  }

  /// The map was asked for last.
  void keep(const std::shared_ptr<Entry>& entry, std::shared_ptr<const EnvironmentMap> map) {
    const std::lock_guard lock(mutex);
    const auto found = std::ranges::find(kept, entry, &Kept::entry);
    if (found != kept.end()) return kept.splice(kept.begin(), kept, found);
    kept_texels += entry->texels;
    kept.push_front({entry, std::move(map)});
  }

  std::string identity(const Entry& entry) {
    const std::lock_guard lock(mutex);
    return entry.identity;
  }

  std::shared_ptr<const EnvironmentMap> load(const std::shared_ptr<Entry>& entry) {
    const std::lock_guard lock(entry->reading);
    std::shared_ptr<const EnvironmentMap> map = entry->map.lock();
    if (map == nullptr) {
      make_room(entry->texels);
      map = std::make_shared<const EnvironmentMap>(entry->read_again());
      if (identity_of(*map) != identity(*entry)) {
        throw InputError(fmt::format(
            "{}: the file has changed since this run read it first: leave files alone until the "
            "run has ended, and start it again",
            entry->source));
      }
      entry->map = map;
    }
    keep(entry, map);
    return map;
  }

  std::size_t most_texels;
  std::mutex mutex;
  std::list<Kept> kept;  ///< the last one asked for first
  std::size_t kept_texels = 0;
};

MapStore::MapStore(std::size_t most_texels) : state_(std::make_shared<State>(most_texels)) {}

MapSource MapStore::add(EnvironmentMap map, std::function<EnvironmentMap()> read_again) {
  MapSource source = described(map);
  const auto entry = std::make_shared<Entry>();
  entry->source = user_name_of(map);
  entry->texels = map.radiance.extent().count();
  entry->read_again = std::move(read_again);
  state_->make_room(entry->texels);
  auto kept = std::make_shared<const EnvironmentMap>(std::move(map));
  entry->map = kept;
  state_->keep(entry, std::move(kept));
  source.load = [state = state_, entry] { return state->load(entry); };
  return source;
}

}  // namespace lightproof
