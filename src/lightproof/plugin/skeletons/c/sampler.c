/* A sampler of environment maps as a plug-in of Lightproof: texels in proportion to luminance times
 * solid angle, found by binary search in sums of rows and of columns; positions uniform in the
 * picture inside a texel (density C). Put your own in its place. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "lightproof_plugin.h"

static const double kPi = 3.14159265358979323846;
/* How close to the edge of a texel a sample may come, in texels: at a pole there is no density. */
static const double kEdge = 1e-9;

typedef struct {
  uint32_t width, height;
  double* rows;    /* height + 1 sums of the probabilities of rows, from the top */
  double* columns; /* for each row width + 1 sums of the probabilities of its texels */
} Sampler;

static void destroy(void* pointer) {
  Sampler* self = (Sampler*)pointer;
  if (self == NULL) return;
  free(self->rows);
  free(self->columns);
  free(self);
}

/* Turns weights behind sums[0] into sums that end at 1, and returns what they were in all. */
static double make_sums(double* sums, uint32_t count) {
  double total = 0.0;
  sums[0] = 0.0;
  for (uint32_t i = 1; i <= count; ++i) sums[i] = total += sums[i];
  for (uint32_t i = 1; i <= count; ++i) sums[i] = total > 0.0 ? sums[i] / total : 0.0;
  return total;
}

static void* create(const lightproof_map* map, char* error, size_t error_bytes) {
  const uint32_t width = map->width, height = map->height;
  Sampler* self = (Sampler*)calloc(1, sizeof *self);
  if (self != NULL) {
    self->width = width;
    self->height = height;
    self->rows = (double*)malloc(((size_t)height + 1) * sizeof(double));
    self->columns = (double*)malloc((size_t)height * ((size_t)width + 1) * sizeof(double));
  }
  if (self == NULL || self->rows == NULL || self->columns == NULL) {
    snprintf(error, error_bytes, "no memory for %u x %u texels", width, height);
    destroy(self);
    return NULL;
  }
  for (uint32_t row = 0; row < height; ++row) {
    /* The solid angle of a texel of this row. */
    const double solid_angle =
        2.0 * kPi / width * (cos(kPi * row / height) - cos(kPi * (row + 1.0) / height));
    double* sums = self->columns + (size_t)row * ((size_t)width + 1);
    for (uint32_t column = 0; column < width; ++column) {
      const float* rgb = map->texels + 3 * ((size_t)row * width + column);
      const double luminance = map->luminance[0] * (double)rgb[0] +
                               map->luminance[1] * (double)rgb[1] +
                               map->luminance[2] * (double)rgb[2];
      sums[column + 1] = luminance * solid_angle;
    }
    self->rows[row + 1] = make_sums(sums, width);
  }
  if (make_sums(self->rows, height) <= 0.0) {
    snprintf(error, error_bytes, "the map is black");
    destroy(self);
    return NULL;
  }
  return self;
}

/* The i with sums[i] <= u < sums[i + 1]: never one without probability. */
static uint32_t find(const double* sums, uint32_t count, double u) {
  uint32_t low = 0, high = count;
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    if (sums[middle] <= u) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

/* How far u lies on its way through step i, from 0 to 1, but for the edges. */
static double fraction(const double* sums, uint32_t i, double u) {
  const double share = (u - sums[i]) / (sums[i + 1] - sums[i]);
  return fmin(fmax(share, kEdge), 1.0 - kEdge);
}

/* The density per steradian of texel (column, row), at a point of this sine of theta. */
static double density(const Sampler* self, uint32_t column, uint32_t row, double sine) {
  const double* sums = self->columns + (size_t)row * ((size_t)self->width + 1);
  const double mass = (self->rows[row + 1] - self->rows[row]) * (sums[column + 1] - sums[column]);
  return sine > 0.0 ? mass * self->width * self->height / (2.0 * kPi * kPi * sine) : 0.0;
}

static void sample(void* pointer, size_t count, const double* u, double* rows) {
  const Sampler* self = (const Sampler*)pointer;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t row = find(self->rows, self->height, u[2 * i + 1]);
    const double* sums = self->columns + (size_t)row * ((size_t)self->width + 1);
    const uint32_t column = find(sums, self->width, u[2 * i]);
    const double theta = kPi * (row + fraction(self->rows, row, u[2 * i + 1])) / self->height;
    const double phi = kPi - 2.0 * kPi * (column + fraction(sums, column, u[2 * i])) / self->width;
    const double sine = sin(theta);
    rows[4 * i] = sine * cos(phi);
    rows[4 * i + 1] = sine * sin(phi);
    rows[4 * i + 2] = cos(theta);
    rows[4 * i + 3] = density(self, column, row, sine);
  }
}

static uint32_t cell(double coordinate, uint32_t count) {
  const double at = floor(coordinate * count);
  return at < 0.0 ? 0 : at >= count ? count - 1 : (uint32_t)at;
}

static void pdf(void* pointer, size_t count, const double* positions, double* densities) {
  const Sampler* self = (const Sampler*)pointer;
  for (size_t i = 0; i < count; ++i) {
    const double x = positions[3 * i], y = positions[3 * i + 1], z = positions[3 * i + 2];
    const double sine = hypot(x, y);
    const uint32_t row = cell(atan2(sine, z) / kPi, self->height);
    const uint32_t column = cell(0.5 - atan2(y, x) / (2.0 * kPi), self->width);
    densities[i] = density(self, column, row, sine);
  }
}

LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe(void) {
  static const lightproof_plugin plugin = {
      LIGHTPROOF_PLUGIN_ABI,
      sizeof(lightproof_plugin),
      "@NAME@",      /* name */
      NULL,          /* columns: x,y,z,pdf */
      NULL,          /* axes: z up, right-handed */
      "z-up",        /* preset */
      "solid-angle", /* measure of densities */
      "C",           /* density */
      NULL,          /* luminance: by the weights of the map */
      0.0,           /* rounding: up to that of floats */
      create,
      sample,
      NULL, /* draw: sample() is there */
      pdf,
      destroy,
  };
  return &plugin;
}
