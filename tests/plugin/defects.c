/* Plug-ins that are right in their own ways, or have one defect each: the sampler that `lightproof
 * new-plugin c` writes, changed as LIGHTPROOF_DEFECT says. */
#define _GNU_SOURCE

#define lightproof_plugin_describe correct_plugin
#include "lightproof/plugin/skeletons/c/sampler.c"
#undef lightproof_plugin_describe

#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

LIGHTPROOF_PLUGIN_EXPORT const lightproof_plugin* lightproof_plugin_describe(void);

static int is(const char* defect) { return strcmp(LIGHTPROOF_DEFECT, defect) == 0; }

/* Whether a random number is one of the few at which something happens. */
static int is_struck(const double* u) { return u[0] > 0.7 && u[0] < 0.7005 && u[1] > 0.5; }

/* A megabyte on both streams, by somebody who cannot go on without it. */
static void print_much(void) {
  static int is_printed = 0;
  if (is_printed) return;
  is_printed = 1;
  char words[4096];
  memset(words, 'w', sizeof words);
  for (int i = 0; i < 256; ++i) {
    if (write(1 + i % 2, words, sizeof words) != (ssize_t)sizeof words) abort();
  }
}

enum { kLateBytes = 64 << 20 };

/* Memory that nobody gives back; the compiler may not leave it out. */
static void* volatile last_kept = NULL;
static void keep(size_t bytes) {
  last_kept = malloc(bytes);
  memset(last_kept, 1, bytes);
}

/* A table that is made when it is first needed. */
static void keep_once(int* is_kept, size_t bytes) {
  if (!*is_kept) keep(bytes);
  *is_kept = 1;
}

static void strike(void) {
  if (is("last-words")) {
    printf("the last words\n");
    abort();
  }
  if (is("crash")) *(volatile int*)NULL = 0;
  if (is("hang")) {
    for (;;) pause();
  }
  if (is("spin")) {
    for (volatile int i = 0;; ++i) {
    }
  }
  if (is("exit")) exit(3);
  if (is("fork")) fork();
  if (is("program")) execl("/bin/true", "true", (char*)NULL);
}

static void turn(double* row, double angle) {
  const double x = row[0], y = row[1];
  row[0] = cos(angle) * x - sin(angle) * y;
  row[1] = sin(angle) * x + cos(angle) * y;
}

/* The samples of the last call, if it was one for samples; and how often one could be forgotten. */
static size_t last_drawn = 0;
static int forgotten = 0;

/* Draws with the correct sampler, and changes what comes out. */
static void changed_sample(void* pointer, size_t count, const double* u, double* rows) {
  const Sampler* self = (const Sampler*)pointer;
  /* Once, right after a batch of samples, which are what is left there. */
  const int repeats = count >= 1024 && last_drawn == count;
  last_drawn = count;
  const int leaves_half = is("silent") || (is("forgets") && repeats && ++forgotten == 1);
  sample(pointer, leaves_half ? count / 2 : count, u, rows);
  for (size_t i = 0; i < count; ++i) {
    double* row = rows + 4 * i;
    if (is_struck(u + 2 * i)) strike();
    if (is("slow") && (count == 1 || count > 1000)) nanosleep(&(struct timespec){0, 3000000}, NULL);
    if (is("nan") && is_struck(u + 2 * i)) row[0] = NAN;
    if (is("no-jacobian")) row[3] *= hypot(row[0], row[1]);
    if (is("flipped-t")) row[2] = -row[2];
    if (is("off-by-one")) turn(row, 2.0 * kPi / self->width);
    if (is("leak")) keep(4096);
    if (is("leaks-little")) keep(100);
    if (is("rounded")) {
      double length = 0.0;
      for (int k = 0; k < 3; ++k) row[k] = rint(row[k] * 16384.0) / 16384.0;
      for (int k = 0; k < 3; ++k) length += row[k] * row[k];
      for (int k = 0; k < 3; ++k) row[k] /= sqrt(length);
    }
    if (is("floats")) {
      for (int k = 0; k < 4; ++k) row[k] = (double)(float)row[k];
    }
    if (is("y-up")) {
      const double y = row[1];
      row[1] = row[2];
      row[2] = -y;
    }
  }
  if (is("prints")) {
    printf("drew %zu samples\n", count);
    fprintf(stderr, "%01000d\n", 7);
  }
  if (is("prints-much")) print_much();
  static int has_table = 0;
  if (is("allocates-late")) keep_once(&has_table, kLateBytes);
  if (is("once") && count > 1) {
    static int batches = 0;
    if (++batches == 20) abort();
  }
  if (is("closes")) {
    for (int descriptor = 0; descriptor < 64; ++descriptor) close(descriptor);
  }
}

static void changed_pdf(void* pointer, size_t count, const double* positions, double* densities) {
  last_drawn = 0;
  static int has_table = 0;
  if (is("allocates-late")) keep_once(&has_table, kLateBytes);
  for (size_t i = 0; i < count; ++i) {
    double at[3] = {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    if (is("y-up")) {
      at[1] = -positions[3 * i + 2];
      at[2] = positions[3 * i + 1];
    }
    if (is("crash-in-pdf") && at[2] > 0.9) *(volatile int*)NULL = 0;
    pdf(pointer, 1, at, densities + i);
    if (is("no-jacobian")) densities[i] *= hypot(at[0], at[1]);
    if (is("other-pdf")) densities[i] = 1.0 / (4.0 * kPi);
  }
}

/* Positions in the picture, with their density over it. */
static void picture_sample(void* pointer, size_t count, const double* u, double* rows) {
  for (size_t i = 0; i < count; ++i) {
    double row[4];
    sample(pointer, 1, u + 2 * i, row);
    const double sine = hypot(row[0], row[1]);
    rows[3 * i] = 0.5 - atan2(row[1], row[0]) / (2.0 * kPi);
    rows[3 * i + 1] = atan2(sine, row[2]) / kPi;
    rows[3 * i + 2] = row[3] * 2.0 * kPi * kPi * sine;
  }
}

static void picture_pdf(void* pointer, size_t count, const double* positions, double* densities) {
  for (size_t i = 0; i < count; ++i) {
    const double phi = kPi - 2.0 * kPi * positions[2 * i], theta = kPi * positions[2 * i + 1];
    const double at[3] = {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
    pdf(pointer, 1, at, densities + i);
    densities[i] *= 2.0 * kPi * kPi * sin(theta);
  }
}

/* The generator of Steele, Lea and Flood (2014), SplitMix64. */
static double next_number(uint64_t* state) {
  uint64_t z = (*state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static void draw(void* pointer, uint64_t seed, uint64_t first, size_t count, double* rows) {
  uint64_t state = seed * 0xd1342543de82ef95u + first * 0x9e3779b97f4a7c15u * 4096u;
  for (size_t i = 0; i < count; ++i) {
    double u[2], row[4];
    u[0] = next_number(&state);
    u[1] = next_number(&state);
    if (is("in-order-crash") && first + i == 5000) abort();
    sample(pointer, 1, u, row);
    memcpy(rows + 3 * i, row, 3 * sizeof *row);
  }
}

/* Luminance alone, without the solid angles of rows. */
static void* changed_create(const lightproof_map* map, char* error, size_t error_bytes) {
  if (is("refuses")) {
    snprintf(error, error_bytes, "only %s will do", "square maps");
    return NULL;
  }
  if (!is("no-sine")) return create(map, error, error_bytes);
  const size_t line = 3 * (size_t)map->width;
  float* texels = (float*)malloc(line * map->height * sizeof *texels);
  for (uint32_t row = 0; row < map->height; ++row) {
    const double sine = sin(kPi * (row + 0.5) / map->height);
    for (size_t i = 0; i < line; ++i) {
      texels[row * line + i] = (float)(map->texels[row * line + i] / sine);
    }
  }
  lightproof_map changed = *map;
  changed.texels = texels;
  void* sampler = create(&changed, error, error_bytes);
  free(texels);
  return sampler;
}

static void changed_destroy(void* pointer) {
  destroy(pointer);
  if (is("crash-at-the-end")) abort();
  if (is("exit-at-the-end")) exit(3);
  if (is("fork-at-the-end")) fork();
  if (is("hang-at-the-end")) {
    for (;;) pause();
  }
}

/* Answers in the place of the program that loaded it: five numbers of eight bytes, of which the
 * last is the length of the text that follows. */
static void answer(const uint64_t* reply, const char* text) {
  for (int descriptor = 0; descriptor < 64; ++descriptor) {
    if (send(descriptor, reply, 5 * sizeof *reply, MSG_NOSIGNAL) <= 0) continue;
    send(descriptor, text, strlen(text), MSG_NOSIGNAL);
  }
}

__attribute__((constructor)) static void at_load(void) {
  if (is("crash-at-load")) abort();
  if (is("no-reply")) answer((const uint64_t[]){7, 0, 0, 0, 3}, "abc");
  if (is("endless-reply")) answer((const uint64_t[]){0, 0, 0, 0, UINT64_MAX}, "abc");
  if (is("no-description")) answer((const uint64_t[]){0, 0, 0, 0, 3}, "abc");
}

const lightproof_plugin* lightproof_plugin_describe(void) {
  static lightproof_plugin plugin;
  plugin = *correct_plugin();
  plugin.name = LIGHTPROOF_DEFECT;
  plugin.create = changed_create;
  plugin.sample = changed_sample;
  plugin.pdf = changed_pdf;
  plugin.destroy = changed_destroy;
  if (is("nothing")) return NULL;
  if (is("other-version")) plugin.abi = LIGHTPROOF_PLUGIN_ABI + 1;
  if (is("short")) plugin.size = 16;
  if (is("no-create")) plugin.create = NULL;
  if (is("no-samples")) plugin.sample = NULL;
  if (is("other-words")) plugin.density = "D";
  if (is("other-columns")) plugin.columns = "x,y";
  if (is("strange-name")) plugin.name = "a/b";
  static char endless[1000];
  memset(endless, 'n', sizeof endless - 1);
  if (is("endless-name")) plugin.name = endless;
  if (is("y-up")) plugin.axes = "x,-z,y";
  if (is("rounded")) plugin.rounding = 1e-4;
  if (is("picture")) {
    plugin.columns = "u,v,pdf";
    plugin.preset = "exr-area";
    plugin.measure = "square";
    plugin.sample = picture_sample;
    plugin.pdf = picture_pdf;
  }
  if (is("in-order") || is("in-order-crash")) {
    plugin.columns = "x,y,z";
    plugin.sample = NULL;
    plugin.draw = draw;
    plugin.pdf = NULL;
  }
  return &plugin;
}
