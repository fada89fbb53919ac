// Writes the page of a made-up precomputation, for looking at and for the browser test:
//   write_sample_contact_sheet FILE
#include <cstdio>
#include <exception>
#include <filesystem>

#include "lightproof/core/atomic_file.h"
#include "lightproof/report/contact_sheet.h"
#include "precomputation_fixture.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_sample_contact_sheet FILE\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path file = arguments[1];
    std::filesystem::create_directories(file.parent_path());
    lightproof::write_file(
        file, lightproof::contact_sheet(lightproof::testing::synthetic_precomputation()));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
