# Script and style of the report's page, from npm packages of locked versions: ${web_bundle} is a source file of ours.
# Node is needed to build, not to run. Tests import from ${web_modules}.
set(web_folder ${CMAKE_CURRENT_LIST_DIR})
set(web_build ${CMAKE_CURRENT_BINARY_DIR}/web)
set(web_modules ${web_build}/node_modules)
set(web_bundle ${web_build}/web_bundle.cc)
file(MAKE_DIRECTORY ${web_build})

add_custom_command(OUTPUT ${web_modules}/.package-lock.json
  COMMAND ${CMAKE_COMMAND} -E copy ${web_folder}/package.json ${web_folder}/package-lock.json ${web_build}
  COMMAND ${NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error
  COMMAND ${CMAKE_COMMAND} -E touch ${web_modules}/.package-lock.json
  DEPENDS ${web_folder}/package.json ${web_folder}/package-lock.json
  WORKING_DIRECTORY ${web_build}
  COMMENT "Installing the npm packages of the report's page"
  VERBATIM)

set(web_sources
  src/chart_data.js
  src/charts.js
  src/colour_map.js
  src/dom.js
  src/downloads.js
  src/main.js
  src/organs.js
  src/page.css
  src/payload.js
  src/slices.js
  src/surroundings.js
  src/viewer.js
  src/viewer_panel.js
  src/worst.js)
list(TRANSFORM web_sources PREPEND ${web_folder}/)
add_custom_command(OUTPUT ${web_bundle}
  COMMAND ${NODE} ${web_folder}/build.mjs ${web_bundle} ${web_modules}
  DEPENDS ${web_folder}/build.mjs ${web_sources} ${web_modules}/.package-lock.json
  COMMENT "Bundling the script of the report's page"
  VERBATIM)
