// What new-plugin writes, as values; that it works is tested with the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lightproof/plugin/skeleton.h"

namespace lightproof {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

TEST(Skeleton, HasItsNameTheHeaderAndWhatBuildsIt) {
  for (const SkeletonLanguage& language : skeleton_languages()) {
    const std::vector<SkeletonFile> files = skeleton(language, "mine");
    EXPECT_THAT(files, Contains(Field(&SkeletonFile::path, "lightproof_plugin.h")));
    EXPECT_THAT(files, Contains(Field(&SkeletonFile::path,
                                      language.name == "rust" ? "Cargo.toml" : "CMakeLists.txt")));
    EXPECT_THAT(files, Contains(Field(&SkeletonFile::text, HasSubstr("\"mine\""))));
    for (const SkeletonFile& file : files) EXPECT_THAT(file.text, Not(HasSubstr("@NAME@")));
  }
}

TEST(Skeleton, IsCalledAsItsFolderWhereThatIsAName) {
  EXPECT_EQ(sampler_name_of("mine"), "mine");
  EXPECT_EQ(sampler_name_of("my sampler-2"), "my_sampler_2");
  EXPECT_EQ(sampler_name_of("3d"), "sampler_3d");
  EXPECT_EQ(sampler_name_of(""), "sampler_");
}

}  // namespace
}  // namespace lightproof
