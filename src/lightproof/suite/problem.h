// What the gate tests: a law, and the samplers that claim to draw it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/samplers/mass_rounding.h"
#include "lightproof/suite/bound_sampler.h"
#include "lightproof/suite/checks.h"
#include "lightproof/suite/expectation.h"
#include "lightproof/suite/results.h"

namespace lightproof {

/// A sampler under test: one of a registry, a mutant, a stranger's.
struct Candidate {
  std::string name;
  bool known_defects = false;
  /// Builds it.
  std::function<BoundSampler()> bind;
  /// Step of its sums and random numbers: a float's below 1 unless it is known to be finer, 0 if it
  /// searches no sums of rows and columns.
  double resolution = 0x1p-24;
  /// How far its probabilities of texels may be from the declared ones.
  MassRounding rounding = {};
  /// Whether u.t alone, all its 53 bits, gives its row and the share of the row's mass below it.
  bool inverts_rows = false;
  /// Whether it claims to return the texels of the problem's twin, point for point.
  bool has_twin = false;
  /// What is found does not depend on the seed.
  std::function<Inspection(const BoundSampler&, const Expectation&, const MassRounding&)> inspect =
      lightproof::inspect;
};

/// What could be drawn by mistake.
struct Alternative {
  std::string_view name;       ///< "no-sine"
  std::string_view diagnosis;  ///< "a missing sin(theta)"
  std::function<Grid<double>()> masses;
};

/// One law over (phi, theta) and its candidates. The parts are made when they are needed: a run
/// over many maps holds few of them at once, and shares what it holds.
struct Problem {
  std::string map;        ///< name of the map, or kDirections
  std::string weighting;  ///< "A", "B"; empty for laws over directions
  std::string source;     ///< of the map, as it was given
  std::function<std::shared_ptr<const Expectation>()> expectation;
  std::function<std::vector<Alternative>()> alternatives;
  std::vector<Candidate> candidates;
  /// A sampler that others are held against; there if any candidate has a twin.
  std::function<BoundSampler()> twin = {};
};

/// The same problem for many runs: the inspection of each candidate, which no seed changes, is made
/// by the first run that asks for it, and kept.
Problem inspected_once(Problem problem);

/// The same problem for many runs: the exact side, the samplers and their inspections are made now,
/// and kept.
Problem made_once(Problem problem);

}  // namespace lightproof
