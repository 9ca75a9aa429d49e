# Run at build time: cmake -D ROOT=… -D OUTPUT=… -D VERSION=… -D BUILD=… -P version.cmake
# Writes version.cc, and touches it only when something has changed.
set(folders registration registration/tracking reference_fe reference_fe/decks synthetic/dataset synthetic/anatomy synthetic/observation
            synthetic/observation/images
            validation/metrics validation/runner validation/report)

set(revision unknown)
find_program(git git)
if(git)
  # The repository may belong to another user (CI, containers): reading its revision is harmless.
  set(git_here ${git} -c safe.directory=* -C ${ROOT})
  execute_process(COMMAND ${git_here} rev-parse --show-toplevel OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET)
  if(top STREQUAL ROOT)
    execute_process(COMMAND ${git_here} rev-parse --short=12 HEAD OUTPUT_VARIABLE revision
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    execute_process(COMMAND ${git_here} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      string(APPEND revision "+changes")
    endif()
  endif()
endif()

set(digests "")
foreach(folder ${folders})
  file(GLOB_RECURSE sources LIST_DIRECTORIES false RELATIVE ${ROOT} "${ROOT}/${folder}/*")
  # The solver knows nothing of decks, registration and outlines nothing of images, and each result has its own case's text.
  list(FILTER sources EXCLUDE REGEX "^${folder}/(decks|cases|tracking|images)/")
  list(FILTER sources EXCLUDE REGEX "^synthetic/dataset/image_series")
  if(folder STREQUAL "synthetic/observation/images")
    list(APPEND sources synthetic/dataset/image_series.h)
  endif()
  list(SORT sources)
  set(all "")
  foreach(source ${sources})
    file(SHA256 "${ROOT}/${source}" digest)
    string(APPEND all "${source} ${digest}\n")
  endforeach()
  string(SHA256 digest "${all}")
  string(APPEND digests "      {\"${folder}\", \"${digest}\"},\n")
endforeach()

file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT [[
// Made by version.cmake.
#include "validation/cli/version.h"

#include <map>

namespace pelvireg::cli
{
std::string version() { return "@VERSION@"; }
std::string revision() { return "@revision@"; }
std::string build() { return "@BUILD@"; }

std::string source_digest(const std::string &folder)
{
  static const std::map<std::string, std::string> digests = {
@digests@  };
  return digests.at(folder);
}
} // namespace pelvireg::cli
]])
