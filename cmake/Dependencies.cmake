# The libraries Lightproof stands on; every one is a package of Debian 12. Who uses the installed libraries
# finds the same ones by cmake/lightproofConfig.cmake.in.
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(hwy REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(SQLite3 REQUIRED)
# Version 4, or 3 where that is what there is.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()

# Random123 is headers only and brings no package file.
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
