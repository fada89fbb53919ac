# Generates embedded.cpp, which holds the page's assets and the chart libraries.
set(LIGHTPROOF_WEB_MODULES ${PROJECT_SOURCE_DIR}/web/node_modules CACHE PATH
    "node_modules with vega, vega-lite and vega-embed, as installed from web/package-lock.json")

# What the three bundles contain besides themselves: licence texts go into the report with them.
set(bundled_packages
  vega vega-lite vega-embed vega-themes vega-tooltip vega-interpreter d3-array d3-delaunay
  delaunator robust-predicates d3-geo-projection internmap topojson-client fast-json-patch
  json-stringify-pretty-compact semver tslib)

set(embedded_files
  ${CMAKE_CURRENT_SOURCE_DIR}/assets/page.css
  ${CMAKE_CURRENT_SOURCE_DIR}/assets/page.js
  ${LIGHTPROOF_WEB_MODULES}/vega/build/vega.min.js
  ${LIGHTPROOF_WEB_MODULES}/vega-lite/build/vega-lite.min.js
  ${LIGHTPROOF_WEB_MODULES}/vega-embed/build/vega-embed.min.js)
foreach(file IN LISTS embedded_files)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "${file} is missing, and the report cannot be built without it. "
      "Run ci/setup (or `npm ci` in ${PROJECT_SOURCE_DIR}/web), or set LIGHTPROOF_WEB_MODULES.")
  endif()
endforeach()

set(licences "")
foreach(package IN LISTS bundled_packages)
  file(GLOB found LIST_DIRECTORIES false ${LIGHTPROOF_WEB_MODULES}/${package}/LICEN[SC]E*)
  foreach(file IN LISTS found)
    file(READ ${file} text)
    string(APPEND licences "${package}\n\n${text}\n\n")
  endforeach()
endforeach()
file(CONFIGURE OUTPUT licences.txt CONTENT "@licences@" @ONLY)

configure_file(embedded.cpp.in embedded.cpp @ONLY)
set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp PROPERTIES
  OBJECT_DEPENDS "${embedded_files};${CMAKE_CURRENT_BINARY_DIR}/licences.txt")
