// A map from a file, which the installed decoder decodes: its size.
#include <cstdio>

#include "lightproof/image/reader.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const lightproof::EnvironmentMap map = lightproof::read_environment_map(argv[1]);
  std::printf("%d x %d\n", map.radiance.extent().width, map.radiance.extent().height);
  return 0;
}
