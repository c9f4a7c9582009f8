# Writes OUTPUT, the source that knows the version, and only if it has changed, so that a build after a
# commit compiles one small file. Run by every build; OUTPUT, SOURCE_DIR and VERSION come with -D.
set(commit "")
find_program(GIT git)
if(GIT)
  # SOURCE_DIR may lie inside a checkout of something else: then its prefix is not empty.
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --show-prefix
                  OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                  RESULT_VARIABLE failed)
  if(NOT failed AND prefix STREQUAL "")
    # No optional locks: a build must not get in the way of a commit made at the same time.
    execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0
                            ${GIT} -C ${SOURCE_DIR} describe --always --exclude=* --abbrev=10
                            --dirty=+changes
                    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
set(text "${VERSION}")
if(commit)
  set(text "${VERSION} (${commit})")
endif()
set(source "#include \"engine/cli/version.hpp\"

namespace spheroscope::cli {

std::string version_text() { return \"${text}\"; }

}  // namespace spheroscope::cli
")
set(present "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} present)
endif()
if(NOT present STREQUAL source)
  file(WRITE ${OUTPUT} "${source}")
endif()
