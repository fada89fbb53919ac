/* A sampler of environment maps as a plug-in: texels in proportion to luminance times solid angle
 * (density C), found by binary search in one row of sums over all of them; positions in the
 * picture, with their density over it. With FORGET_SINE it leaves out the solid angle. */
#include <lightproof/plugin/lightproof_plugin.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double kPi = 3.14159265358979323846;
/* How close to the edge of a texel a sample may come, in texels: at a pole there is no density. */
static const double kEdge = 1e-9;

typedef struct {
  size_t width, height;
  double
      sums[]; /* before each texel, in the order of the picture, and behind the last one: 0 to 1 */
} Light;

static double weight(const lightproof_map* map, size_t texel) {
  const float* rgb = map->texels + 3 * texel;
  const double luminance =
      map->luminance[0] * rgb[0] + map->luminance[1] * rgb[1] + map->luminance[2] * rgb[2];
#ifdef FORGET_SINE
  return luminance;
#else
  /* Solid angles of texels are to each other as the sines at the middle of their rows. */
  return luminance * sin(kPi * ((double)(texel / map->width) + 0.5) / map->height);
#endif
}

static void* create(const lightproof_map* map, char* error, size_t error_bytes) {
  const size_t count = (size_t)map->width * map->height;
  Light* light = malloc(sizeof *light + (count + 1) * sizeof *light->sums);
  if (light == NULL) {
    snprintf(error, error_bytes, "no memory for %zu texels", count);
    return NULL;
  }
  light->width = map->width;
  light->height = map->height;
  double total = 0.0;
  for (size_t i = 0; i < count; ++i) {
    light->sums[i] = total;
    total += weight(map, i);
  }
  if (total <= 0.0) {
    snprintf(error, error_bytes, "the map is black");
    free(light);
    return NULL;
  }
  for (size_t i = 0; i < count; ++i) light->sums[i] /= total;
  light->sums[count] = 1.0;
  return light;
}

static double probability(const Light* light, size_t texel) {
  return light->sums[texel + 1] - light->sums[texel];
}

/* The texel with sums[texel] <= u < sums[texel + 1]: never one without probability. */
static size_t find(const Light* light, double u) {
  size_t low = 0, high = light->width * light->height;
  while (high - low > 1) {
    const size_t middle = low + (high - low) / 2;
    if (light->sums[middle] <= u) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

static double inside(double share) { return fmin(fmax(share, kEdge), 1.0 - kEdge); }

static void sample(void* pointer, size_t count, const double* u, double* rows) {
  const Light* light = pointer;
  const size_t texels = light->width * light->height;
  for (size_t i = 0; i < count; ++i, u += 2, rows += 3) {
    const size_t texel = find(light, u[0]);
    const double along = (u[0] - light->sums[texel]) / probability(light, texel);
    rows[0] = ((double)(texel % light->width) + inside(along)) / (double)light->width;
    rows[1] = ((double)(texel / light->width) + inside(u[1])) / (double)light->height;
    rows[2] = probability(light, texel) * (double)texels;
  }
}

static size_t cell(double coordinate, size_t count) {
  const double at = coordinate * (double)count;
  return at < 0.0 ? 0 : at >= (double)count ? count - 1 : (size_t)at;
}

static void pdf(void* pointer, size_t count, const double* positions, double* densities) {
  const Light* light = pointer;
  for (size_t i = 0; i < count; ++i, positions += 2) {
    const size_t column = cell(positions[0], light->width);
    const size_t row = cell(positions[1], light->height);
    densities[i] =
        probability(light, row * light->width + column) * (double)(light->width * light->height);
  }
}

LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe(void) {
  static const lightproof_plugin plugin = {
      .abi = LIGHTPROOF_PLUGIN_ABI,
      .size = sizeof plugin,
      .columns = "u,v,pdf",
      .measure = "square",
      .create = create,
      .sample = sample,
      .pdf = pdf,
      .destroy = free,
  };
  return &plugin;
}
