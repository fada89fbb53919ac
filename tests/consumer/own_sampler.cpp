// The gate over a sampler that Lightproof has never seen: uniform over the map, whatever is on it.
// On a constant map under density A that is right; on another one the gate must reject it.
#include <cstdio>
#include <span>

#include "lightproof/gate/gate.h"
#include "lightproof/image/synthetic.h"

namespace {

using namespace lightproof;

class UniformOverMap {
 public:
  explicit UniformOverMap(Extent extent) : extent_(extent) {}

  TexelSample sample(SquarePoint u) const {
    return {u, cell_of(u.s, extent_.width), cell_of(u.t, extent_.height), {1.0}};
  }
  PerSquare pdf(SquarePoint /*at*/) const { return {1.0}; }
  std::size_t table_bytes() const { return 0; }
  Extent extent() const { return extent_; }

 private:
  Extent extent_;
};

Outcome verdict_on(const char* map_name) {
  const EnvironmentMap map = make_synthetic_map(map_name, {64, 32});
  const SamplerUnderTest sampler = {
      .name = "uniform over the map",
      .target = {DensitySpace::texture},
      .bind = [](const EnvironmentMap& on) { return bound(UniformOverMap(on.radiance.extent())); }};
  const GateResult result = run_gate({&map, 1}, {&sampler, 1}, {.samples = 1U << 20U});
  const Outcome outcome = overall_outcome(result, true);
  std::printf("%s: %s\n", map_name, to_string(outcome));
  return outcome;
}

}  // namespace

int main() {
  const bool right = verdict_on("constant") == Outcome::accept;
  return right && verdict_on("gradient") == Outcome::reject ? 0 : 1;
}
