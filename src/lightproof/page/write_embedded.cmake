# cmake -DMODULES=… -DASSETS=… -DTEMPLATE=… -DOUTPUT=… -P write_embedded.cmake: the source that holds
# the page's assets and the chart libraries, and the licence texts of what the bundles contain.
set(bundled_packages
  vega vega-lite vega-embed vega-themes vega-tooltip vega-interpreter d3-array d3-delaunay
  delaunator robust-predicates d3-geo-projection internmap topojson-client fast-json-patch
  json-stringify-pretty-compact semver tslib)

foreach(bundle vega/build/vega vega-lite/build/vega-lite vega-embed/build/vega-embed)
  if(NOT EXISTS ${MODULES}/${bundle}.min.js)
    message(FATAL_ERROR "${MODULES}/${bundle}.min.js is missing, and pages cannot be built without "
      "it. Run ci/setup (or `npm ci` in web/), or set LIGHTPROOF_WEB_MODULES.")
  endif()
endforeach()

set(licences "")
foreach(package IN LISTS bundled_packages)
  file(GLOB found LIST_DIRECTORIES false ${MODULES}/${package}/LICEN[SC]E*)
  foreach(file IN LISTS found)
    file(READ ${file} text)
    string(APPEND licences "${package}\n\n${text}\n\n")
  endforeach()
endforeach()
cmake_path(GET OUTPUT PARENT_PATH folder)
set(LICENCES ${folder}/licences.txt)
file(CONFIGURE OUTPUT ${LICENCES} CONTENT "@licences@" @ONLY)
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
