#include "lightproof/points/registry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "lightproof/core/error.h"

namespace lightproof {
namespace {

/// Makes a set that does not depend on its count.
template <PointSet Set>
AnyPointSet endless(std::uint64_t /*count*/, PointSeed seed) {
  return Set(seed);
}

template <PointSet Set>
AnyPointSet of_count(std::uint64_t count, PointSeed seed) {
  return Set(count, seed);
}

template <std::uint32_t kFirst>
AnyPointSet hammersley_from(std::uint64_t count, PointSeed seed) {
  return Hammersley(count, kFirst, seed);
}

template <std::uint32_t kStep>
AnyPointSet metallic(std::uint64_t count, PointSeed seed) {
  return MetallicLattice(kStep, count, seed);
}

template <const Alpha& kAlpha>
AnyPointSet metallic_float(std::uint64_t count, PointSeed seed) {
  return MetallicLatticeFloat(kAlpha, count, seed);
}

constexpr std::string_view kMetallicSource =
    "the metallic numbers, which the lecture on pre-computed maps names after Roberts 2018";
constexpr std::string_view kFewerBits = "the larger the index, the fewer values are distinct";

constexpr std::array kPointSets = {
    PointSetInfo{.name = "philox",
                 .description = "the generator of all random numbers of Lightproof",
                 .source = "Salmon et al. 2011, Philox4x32-10",
                 .kind = PointKind::random,
                 .make = endless<PhiloxPoints>},
    PointSetInfo{.name = "pcg3d",
                 .description = "hash of pixel and frame, top 24 bits",
                 .source = "Jarzynski and Olano 2020",
                 .kind = PointKind::hash,
                 .make = endless<Pcg3dPoints<FrameIndex::whole>>},
    PointSetInfo{
        .name = "pcg3d converted",
        .description = "pcg3d of a frame index that was a float on its way",
        .source = "Jarzynski and Olano 2020; the lecture on pre-computed maps calls its hash so",
        .kind = PointKind::hash,
        .is_float = true,
        .defect = "from index 2^24 on neighbours are the same point",
        .make = endless<Pcg3dPoints<FrameIndex::converted>>},
    PointSetInfo{.name = "pcg3d counted",
                 .description = "pcg3d of a frame index that is counted as a float",
                 .source = "Jarzynski and Olano 2020; shaders whose frame counter is a float",
                 .kind = PointKind::hash,
                 .is_float = true,
                 .defect = "from index 2^24 on all are the same point",
                 .make = endless<Pcg3dPoints<FrameIndex::counted>>},
    PointSetInfo{.name = "sine hash",
                 .description = "fract(sin(x . (12.9898, 78.233)) 43758.5453)",
                 .source = "shaders, of unknown origin; after Rey 1998",
                 .kind = PointKind::hash,
                 .is_float = true,
                 .defect = "few distinct values",
                 .make = endless<SineHashPoints>},
    PointSetInfo{.name = "stratified",
                 .description = "one uniform point in each cell of a grid",
                 .source = "Cook, Porter and Carpenter 1984",
                 .kind = PointKind::stratified,
                 .is_finite = true,
                 .make = of_count<StratifiedPoints>},
    PointSetInfo{.name = "hammersley",
                 .description = "(n/N, radical inverse of n), n = 0 ... N-1",
                 .source = "Hammersley 1960",
                 .kind = PointKind::net,
                 .is_finite = true,
                 .make = hammersley_from<0>},
    PointSetInfo{.name = "hammersley from 1",
                 .description = "(n/N, radical inverse of n), n = 1 ... N, 1 taken as 0",
                 .source = "the lecture's BRDF integration map",
                 .kind = PointKind::net,
                 .is_finite = true,
                 .make = hammersley_from<1>},
    PointSetInfo{.name = "hammersley float",
                 .description = "(n/N, radical inverse of n), n = 1 ... N, in float",
                 .source = "the lecture's BRDF integration map; in float as shaders have it "
                           "(Dammertz 2012)",
                 .kind = PointKind::net,
                 .is_finite = true,
                 .is_float = true,
                 .defect = "1 is reached, by s at the end and by t from index 2^25 - 2 on",
                 .make = of_count<HammersleyFloat>},
    PointSetInfo{.name = "golden",
                 .description = "(n/N, n times the golden ratio), step 2654435769 of 2^32",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .make = metallic<nearest_step(kGolden)>},
    PointSetInfo{.name = "golden float",
                 .description = "(n/N, fract(n times the golden ratio)) in float",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .is_float = true,
                 .defect = kFewerBits,
                 .make = metallic_float<kGolden>},
    PointSetInfo{.name = "silver",
                 .description = "(n/N, n times the silver ratio), odd step 1779033703 of 2^32",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .make = metallic<nearest_odd_step(kSilver)>},
    PointSetInfo{.name = "silver rounded",
                 .description = "(n/N, n times the silver ratio), nearest step 1779033704 of 2^32",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .defect = "t repeats after 2^29 points",
                 .make = metallic<nearest_step(kSilver)>},
    PointSetInfo{.name = "silver float",
                 .description = "(n/N, fract(n times the silver ratio)) in float",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .is_float = true,
                 .defect = kFewerBits,
                 .make = metallic_float<kSilver>},
    PointSetInfo{.name = "bronze",
                 .description = "(n/N, n times the bronze ratio), odd step 1300411463 of 2^32",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .make = metallic<nearest_odd_step(kBronze)>},
    PointSetInfo{.name = "bronze rounded",
                 .description = "(n/N, n times the bronze ratio), nearest step 1300411462 of 2^32",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .defect = "t repeats after 2^31 points",
                 .make = metallic<nearest_step(kBronze)>},
    PointSetInfo{.name = "bronze float",
                 .description = "(n/N, fract(n times the bronze ratio)) in float",
                 .source = kMetallicSource,
                 .kind = PointKind::lattice,
                 .is_finite = true,
                 .is_float = true,
                 .defect = kFewerBits,
                 .make = metallic_float<kBronze>},
    PointSetInfo{.name = "R2",
                 .description = "1/2 + n (1/g, 1/g^2), g^3 = g + 1, steps 3242174889 and "
                                "2447445414 of 2^32",
                 .source = "Roberts 2018",
                 .kind = PointKind::lattice,
                 .make = endless<R2>},
    PointSetInfo{.name = "R2 float",
                 .description = "fract(1/2 + n (1/g, 1/g^2)), g^3 = g + 1, in float",
                 .source = "Roberts 2018",
                 .kind = PointKind::lattice,
                 .is_float = true,
                 .defect = kFewerBits,
                 .make = endless<R2Float>},
    PointSetInfo{.name = "sobol",
                 .description = "the first two dimensions; Owen-scrambled by a hash, if seeded",
                 .source = "Joe and Kuo 2008; Owen 1995, Burley 2020, Vegdahl 2021",
                 .kind = PointKind::net,
                 .make = endless<Sobol>},
};

}  // namespace

std::string_view to_string(PointKind kind) {
  switch (kind) {
    case PointKind::random:
      return "random";
    case PointKind::hash:
      return "hash";
    case PointKind::stratified:
      return "stratified";
    case PointKind::lattice:
      return "lattice";
    case PointKind::net:
      return "net";
  }
  return "";
}

AnyPointSet PointSetInfo::prepare(std::uint64_t count, PointSeed seed) const {
  if (count < 1 || count > kMostPoints) {
    throw InputError("the point set \"" + std::string(name) + "\" cannot have " +
                     std::to_string(count) + " points: 1 to 4294967296 are allowed");
  }
  return make(count, seed);
}

std::span<const PointSetInfo> point_sets() { return kPointSets; }

const PointSetInfo& point_set_by_name(std::string_view name) {
  const auto found = std::find_if(kPointSets.begin(), kPointSets.end(),
                                  [&](const PointSetInfo& row) { return row.name == name; });
  if (found != kPointSets.end()) return *found;
  std::string names;
  for (const PointSetInfo& row : kPointSets) {
    names.append(names.empty() ? "" : ", ").append(row.name);
  }
  throw InputError("there is no point set \"" + std::string(name) + "\": there are " + names);
}

SquarePoint point_of(const AnyPointSet& set, std::uint32_t index) {
  return std::visit([&](const auto& points) { return points.point(index); }, set);
}

void fill_points(const AnyPointSet& set, std::uint64_t first, std::span<SquarePoint> points) {
  assert(first + points.size() <= kMostPoints);
  std::visit(
      [&](const auto& all) {
        for (std::size_t i = 0; i < points.size(); ++i) {
          points[i] = all.point(static_cast<std::uint32_t>(first + i));
        }
      },
      set);
}

}  // namespace lightproof
