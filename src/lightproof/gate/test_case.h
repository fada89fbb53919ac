// What the gate tests: a distribution, and the samplers that claim to draw it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lightproof/gate/bound_sampler.h"
#include "lightproof/gate/exact_checks.h"
#include "lightproof/gate/expectation.h"
#include "lightproof/results/test_record.h"
#include "lightproof/samplers/mass_rounding.h"

namespace lightproof {

/// A sampler under test in one test case, before it is built.
struct SamplerInstance {
  std::string name;
  bool known_defects = false;
  /// Builds the sampler.
  std::function<BoundSampler()> bind;
  /// Step of the sampler's sums and random numbers: a float's below 1 unless it is known to be
  /// finer, 0 if it searches no sums of rows and columns.
  double resolution = 0x1p-24;
  /// How far its probabilities of texels may be from the declared ones.
  MassRounding rounding = {};
  /// Whether u.t alone, all its 53 bits, gives its row and the share of the row's mass below it.
  bool inverts_rows = false;
  /// Whether it claims to return the texels of the test case's reference implementation, point for
  /// point.
  bool claims_reference_texels = false;
  /// Inspects the sampler; what is found does not depend on the seed.
  std::function<Inspection(const BoundSampler&, const Expectation&, const MassRounding&)> inspect =
      lightproof::inspect;
};

/// A distribution that could be drawn by mistake in one test case.
struct Alternative {
  std::string_view name;       ///< "no-sine"
  std::string_view diagnosis;  ///< "a missing sin(theta)"
  std::function<Grid<double>()> masses;
};

/// One distribution over (phi, theta) and its instances. The parts are made when they are needed: a
/// run over many maps holds few of them at once, and shares what it holds.
struct TestCase {
  std::string map;            ///< name of the map, or kDirections
  std::string density_space;  ///< "A", "B", "C"; empty for distributions over directions
  std::string source;         ///< what the user called the map: a path or a built-in name
  std::function<std::shared_ptr<const Expectation>()> expectation;
  std::function<std::vector<Alternative>()> alternatives;
  std::vector<SamplerInstance> instances;
  /// A sampler that others are held against; there if any instance has a reference implementation.
  std::function<BoundSampler()> reference_implementation = {};
  std::size_t texels = 0;  ///< of the map

  /// Whether the map has so many texels that one run alone takes half a gigabyte: one is done after
  /// the other, and what it drew is drawn again rather than kept.
  bool is_large() const { return texels > std::size_t{1} << 22U; }
};

/// A test case for many runs: the inspection of each instance, which no seed changes, is made by
/// the first run that asks for it, and kept.
TestCase inspected_once(TestCase test_case);

/// A test case for many runs: its exact side, its samplers and their inspections are made now, and
/// kept.
TestCase made_once(TestCase test_case);

}  // namespace lightproof
