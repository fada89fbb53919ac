#include "lightproof/materials/material_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lightproof/materials/material_batch.cpp"
#include <hwy/foreach_target.h>
// Highway asks for this order.
#include <hwy/highway.h>

#include "lightproof/materials/lobe_kernels-inl.h"
#include "lightproof/materials/microfacet_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lightproof::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

std::size_t evaluate_front(const Material& /*material*/, const ShadingPoint& /*at*/,
                           const DirectionArrays& /*light*/, std::span<double> /*out*/) {
  return 0;
}
std::size_t sample_front(const Material& /*material*/, const ShadingPoint& /*at*/,
                         std::span<const double> /*s*/, std::span<const double> /*t*/,
                         const MaterialSamples& /*samples*/) {
  return 0;
}

#else

/// Computes whole vectors from the front; returns how many directions that were.
template <class Kernel>
HWY_INLINE std::size_t evaluate_vectors(const Kernel& kernel, const DirectionArrays& light,
                                        std::span<double> out) {
  const Numbers d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= out.size(); i += hn::Lanes(d)) {
    const Directions at = {hn::LoadU(d, light.x.data() + i), hn::LoadU(d, light.y.data() + i),
                           hn::LoadU(d, light.z.data() + i)};
    hn::StoreU(kernel.evaluate(at).reflected_cosine, d, out.data() + i);
  }
  return i;
}

template <class Kernel>
HWY_INLINE std::size_t sample_vectors(const Kernel& kernel, std::span<const double> s,
                                      std::span<const double> t, const MaterialSamples& samples) {
  const Numbers d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= s.size(); i += hn::Lanes(d)) {
    const Directions light = kernel.draw(hn::LoadU(d, s.data() + i), hn::LoadU(d, t.data() + i));
    const Scatterings scattering = kernel.evaluate(light);
    hn::StoreU(light.x, d, samples.x.data() + i);
    hn::StoreU(light.y, d, samples.y.data() + i);
    hn::StoreU(light.z, d, samples.z.data() + i);
    hn::StoreU(scattering.pdf, d, samples.pdf.data() + i);
    hn::StoreU(scattering.reflected_cosine, d, samples.reflected_cosine.data() + i);
  }
  return i;
}

std::size_t evaluate_front(const Material& material, const ShadingPoint& at,
                           const DirectionArrays& light, std::span<double> out) {
  return std::visit([&](const auto& surface)
                        HWY_ATTR { return evaluate_vectors(kernel_of(surface, at), light, out); },
                    material);
}

std::size_t sample_front(const Material& material, const ShadingPoint& at,
                         std::span<const double> s, std::span<const double> t,
                         const MaterialSamples& samples) {
  return std::visit([&](const auto& surface)
                        HWY_ATTR { return sample_vectors(kernel_of(surface, at), s, t, samples); },
                    material);
}

#endif

}  // namespace
}  // namespace lightproof::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lightproof {
namespace {

HWY_EXPORT(evaluate_front);
HWY_EXPORT(sample_front);

}  // namespace

std::size_t reflected_cosines(const Material& material, const ShadingPoint& at,
                              const DirectionArrays& light, std::span<double> reflected_cosine) {
  const std::size_t by_vectors =
      HWY_DYNAMIC_DISPATCH(evaluate_front)(material, at, light, reflected_cosine);
  std::visit(
      [&](const auto& surface) {
        for (std::size_t i = by_vectors; i < reflected_cosine.size(); ++i) {
          const Direction direction = {light.x[i], light.y[i], light.z[i]};
          reflected_cosine[i] = surface.evaluate(at, direction).reflected_cosine;
        }
      },
      material);
  return by_vectors;
}

std::size_t sample_material(const Material& material, const ShadingPoint& at,
                            std::span<const double> s, std::span<const double> t,
                            const MaterialSamples& samples) {
  const std::size_t by_vectors = HWY_DYNAMIC_DISPATCH(sample_front)(material, at, s, t, samples);
  std::visit(
      [&](const auto& surface) {
        for (std::size_t i = by_vectors; i < s.size(); ++i) {
          const auto [direction, scattering] = surface.sample(at, {s[i], t[i]});
          samples.x[i] = direction.x;
          samples.y[i] = direction.y;
          samples.z[i] = direction.z;
          samples.pdf[i] = scattering.pdf.value;
          samples.reflected_cosine[i] = scattering.reflected_cosine;
        }
      },
      material);
  return by_vectors;
}

}  // namespace lightproof
#endif
