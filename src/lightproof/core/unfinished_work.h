// What a run has finished of its work, kept in its folder of results until these are written: a
// later run with the same inputs goes on where the first one was ended, whatever ended it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lightproof/core/executor.h"
#include "lightproof/core/serialise.h"

namespace lightproof {

/// Something that results depend on, by name: {"--seed", "1"}.
struct RunInput {
  std::string name;
  std::string value;

  static auto fields(auto& input) { return std::tie(input.name, input.value); }
  friend bool operator==(const RunInput&, const RunInput&) = default;
};

/// What differs between the inputs of two runs, in words: "--seed was 1 and is 2; the map sky
/// (64x32 0123456789abcdef) is left out". Empty if nothing does.
std::string difference_of(const std::vector<RunInput>& before, const std::vector<RunInput>& now);

/// What is done with work that an earlier run left unfinished in a folder.
enum class Unfinished {
  refused,    ///< an error, which names --resume and --force
  continued,  ///< gone on with, if the inputs are the same; an error if they are not
  discarded,
};

/// The name of the folder in a folder of results in which finished parts are kept meanwhile.
inline constexpr std::string_view kUnfinishedName = "unfinished";

/// Whether a folder is one that UnfinishedWork keeps parts in, and not the user's.
bool is_unfinished_work(const std::filesystem::path& folder);

/// Finished parts of a run: stages, which are kept as they end, and inside of them cells of work,
/// which are kept as they come. Nothing is ever kept by halves, whenever the run is killed; what
/// was damaged later is computed again. If nothing was kept, nothing is left.
class UnfinishedWork {
 public:
  /// Keeps nothing.
  UnfinishedWork();
  /// Keeps parts in `results`, which exists. Throws InputError if it cannot be written, if another
  /// run is at work there, if the user has something of that name, or as `earlier` says.
  UnfinishedWork(const std::filesystem::path& results, const std::vector<RunInput>& inputs,
                 Unfinished earlier);
  ~UnfinishedWork();
  UnfinishedWork(UnfinishedWork&& other) noexcept;
  UnfinishedWork& operator=(UnfinishedWork&& other) = delete;
  UnfinishedWork(const UnfinishedWork&) = delete;
  UnfinishedWork& operator=(const UnfinishedWork&) = delete;

  /// What an earlier run kept of this stage, or what compute(communicator) returns, which is kept
  /// then. Cells that are computed by this communicator are kept one by one, and taken from there
  /// if an earlier run had them. Names of stages are unique. A Value is what ValueWriter and
  /// ValueReader know. Throws InputError if the disk is full.
  template <class Value, class Compute>
  Value stage(const std::string& name, const Compute& compute) const {
    if (auto kept = read<Value>(name)) return *std::move(kept);
    Value value = compute(begin_stage(name));
    ValueWriter writer;
    writer.add(value);
    end_stage(name, writer.take());
    return value;
  }

  /// Whether parts are kept now, of this run or an earlier one.
  bool holds_something() const;
  /// Removes all that is kept: for when the results are written.
  void remove();

 private:
  template <class Value>
  std::optional<Value> read(const std::string& name) const {
    const std::optional<std::string> bytes = find(name);
    if (!bytes) return std::nullopt;
    try {
      ValueReader reader(*bytes);
      auto value = reader.value<Value>();
      return reader.is_at_end() ? std::optional(std::move(value)) : std::nullopt;
    } catch (const std::out_of_range&) {
      return std::nullopt;
    }
  }

  std::optional<std::string> find(const std::string& name) const;
  Communicator begin_stage(const std::string& name) const;
  void end_stage(const std::string& name, std::string_view bytes) const;

  struct Store;
  std::unique_ptr<Store> store_;
};

}  // namespace lightproof
