/* A sampler of environment maps as a shared library that Lightproof tests: the interface,
 * version 1.
 *
 *   lightproof gate MAP --plugin ./libmine.so
 *
 * A library exports one function, lightproof_plugin_describe(), which returns a description: what
 * the sampler's numbers mean, and functions that make a sampler of a map, draw with it, and tell
 * its density. `lightproof new-plugin c|c++|rust DIR` writes one that works. This file is C99,
 * includes nothing but the standard library, and may be copied.
 *
 * Where it runs. Each library is loaded by a process of its own, lightproof-plugin-host. What it
 * does there harms nobody else: a crash, exit(), a batch that takes too long, too much memory, or
 * another process that it starts is a verdict, "rejected", which names the input. What it prints,
 * and whatever destroy() does of these, is shown as a note: the samples stand. It is no sandbox for
 * malicious code: it has the rights of whoever started Lightproof.
 *
 * Memory. Unless --plugin-memory says what it may hold, memory that grows with the samples and
 * densities that were asked for is taken for a leak: beyond 16 MiB, 64 bytes a texel, and 8 bytes
 * for each of them. Tables that are made once, when they are first needed, are none.
 *
 * Threads. All functions are called by one thread of the process, one after the other. There may be
 * several processes at a time, each of which makes the same samplers: nothing may depend on which
 * of them is asked. A library may start threads of its own.
 *
 * Ownership. What Lightproof hands over (maps, random numbers, rows) is its own, and only read or
 * written during the call; a map's texels stay until the sampler made of them was destroyed. What
 * the library hands over (the description and its texts) must stay as long as it is loaded.
 *
 * Versions. LIGHTPROOF_PLUGIN_ABI counts versions that do not understand each other. Within one,
 * structures only grow at their end: `size` says how much of a structure its maker knows, members
 * beyond it are taken for 0, and a library that was built with an older or a newer header of the
 * same version works. Lightproof keeps to version 1 for as long as its own version begins with 0
 * or 1.
 */
#ifndef LIGHTPROOF_PLUGIN_H
#define LIGHTPROOF_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this interface. */
#define LIGHTPROOF_PLUGIN_ABI 1

/** The most samples, or densities, that one call asks for. */
#define LIGHTPROOF_PLUGIN_BATCH 4096

/** The samples of one call of draw(). */
#define LIGHTPROOF_PLUGIN_DRAWN 1024

/** An environment map: what a picture file holds in the convention that the description names by
 * `preset`. */
typedef struct lightproof_map {
  uint32_t size;   /**< sizeof(lightproof_map), as Lightproof knows it */
  uint32_t width;  /**< texels of a row, over all azimuths */
  uint32_t height; /**< rows, from one pole to the other */
  uint32_t unused; /**< 0 */
  /** height rows from the top of the picture, each width texels from the left, each red, green and
   * blue: linear radiance, finite, not negative. Constant inside a texel. In the preset "z-up" the
   * top is +z, and the point (column + a, row + b) of the picture is the direction
   * (sin(theta) cos(phi), sin(theta) sin(phi), cos(theta)) with theta = pi (row + b) / height and
   * phi = pi - 2 pi (column + a) / width. */
  const float* texels;
  const char* name; /**< what the user calls the map */
  /** Weights of red, green and blue in the luminance that the density is declared by: those of
   * `luminance` in the description, or of the user's option. */
  double luminance[3];
} lightproof_map;

/** What a library says of its sampler. Texts may be NULL where a default is named; the words are
 * those of `lightproof check`. */
typedef struct lightproof_plugin {
  uint32_t abi;  /**< LIGHTPROOF_PLUGIN_ABI */
  uint32_t size; /**< sizeof(lightproof_plugin) */

  /** What the sampler goes by: letters, digits, and . _ - ; NULL: the name of the file. */
  const char* name;
  /** What a row of a sample holds: "x,y,z,pdf" (NULL), or "s,t,pdf" (from the left and the bottom
   * of the picture, 0 to 1), or "u,v,pdf" (v from the top), with up to eight columns, of which
   * those called "-" are not read. Without "pdf", samples have no weights. x, y, z are a unit
   * vector. */
  const char* columns;
  /** Which of the sampler's axes Lightproof's x, y and z (up, right-handed) are, as in "x,-z,y";
   * NULL: those of the preset. */
  const char* axes;
  /** The convention of the picture and, unless `axes` says otherwise, of directions: "z-up" (NULL),
   * or another one of latitude and longitude that `lightproof list presets` names. */
  const char* preset;
  /** What densities are per: "solid-angle", a steradian (NULL), or "square", the picture, whose
   * sides are 1. Holds for the column "pdf" and for pdf(). */
  const char* measure;
  /** What the sampler claims to draw: "C" (NULL), texels in proportion to luminance times solid
   * angle and positions uniform in the picture inside a texel; "A", texels in proportion to
   * luminance alone; "B", texels as for C and positions uniform in solid angle. */
  const char* density;
  /** Which luminance: "rec709" (NULL), which follows the user's option; "published", "average". */
  const char* luminance;
  /** By how much, in radians, rounding may move a direction; 0: 5e-7, as single precision does. A
   * sample that is so close to the edge of a texel counts for the side that fits. */
  double rounding;

  /** Makes the sampler of a map. Returns NULL if it cannot, and then may write why to `error`, a
   * text of at most `error_bytes` bytes with its 0. May take ten times as long as a batch. */
  void* (*create)(const lightproof_map* map, char* error, size_t error_bytes);
  /** Draws `count` samples at given random numbers: u[2 i] and u[2 i + 1], uniform in [0, 1), make
   * row i of `rows`, row after row of as many numbers as there are columns. NULL: there is only
   * draw(). A sample depends on its own two random numbers alone. */
  void (*sample)(void* sampler, size_t count, const double* u, double* rows);
  /** Draws samples number first, first + 1, and so on, `count` of them, with random numbers of its
   * own, independent of each other; used where sample() is NULL. They depend on the seed and their
   * number alone. `count` is always LIGHTPROOF_PLUGIN_DRAWN, and `first` a multiple of it: a
   * generator that is seeded by both at the beginning of the call will do. */
  void (*draw)(void* sampler, uint64_t seed, uint64_t first, size_t count, double* rows);
  /** The density with which sample() draws, at `count` positions: each x, y and z, or s and t, or u
   * and v, whichever `columns` names, in this order. Writes one number for each. NULL: not known.
   */
  void (*pdf)(void* sampler, size_t count, const double* positions, double* densities);
  /** Frees what create() returned; has to return within a moment. NULL: nothing has to be freed. */
  void (*destroy)(void* sampler);
} lightproof_plugin;

#if defined(_WIN32)
#define LIGHTPROOF_PLUGIN_EXPORT __declspec(dllexport)
#else
#define LIGHTPROOF_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/** The one function that a library exports: its description, or NULL. */
LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe(void);

#ifdef __cplusplus
}
#endif

#endif
