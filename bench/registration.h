// Each task registers its benchmarks under task/method/map/resolution/order.
#pragma once

namespace lightproof::bench {

void register_sample_benchmarks();
void register_render_benchmarks();

/// Whether a sampler that was to be timed disagreed with the reference.
bool any_disagreement();

}  // namespace lightproof::bench
