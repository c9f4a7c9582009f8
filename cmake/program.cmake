# The program: engine/cli/main.cpp, with the verbs of render/ and viewer/ where these are built.
add_custom_target(spheroscope_version
  COMMAND ${CMAKE_COMMAND} -D OUTPUT=${PROJECT_BINARY_DIR}/version.cpp
          -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D VERSION=${PROJECT_VERSION}
          -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/version.cpp VERBATIM)
set_source_files_properties(${PROJECT_BINARY_DIR}/version.cpp PROPERTIES GENERATED TRUE)

# spheroscope_program(TARGET): the verbs of the engine; what else it has is added below.
function(spheroscope_program target)
  add_executable(${target} engine/cli/main.cpp ${PROJECT_BINARY_DIR}/version.cpp)
  add_dependencies(${target} spheroscope_version)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_link_libraries(${target} PRIVATE spheroscope_cli)
  target_compile_options(${target} PRIVATE -O1)
  spheroscope_precompiled(${target} text)
endfunction()

spheroscope_program(spheroscope)

# What SPHEROSCOPE_RENDER=OFF makes. Tests of verbs that draw nothing call this one: it starts in a tenth of the
# time, which the other spends on the libraries of VTK and OSMesa, and it is tested without a second build.
spheroscope_program(spheroscope_engine)
set_target_properties(spheroscope_engine PROPERTIES EXCLUDE_FROM_ALL TRUE)

# render/verb*.cpp belong to the program, not to the library of pictures: they know the command line.
file(GLOB render_verbs CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/render/verb*.cpp)
if(SPHEROSCOPE_RENDER AND render_verbs)
  target_sources(spheroscope PRIVATE ${render_verbs})
  target_compile_definitions(spheroscope PRIVATE SPHEROSCOPE_HAS_RENDER)
  spheroscope_use_render(spheroscope)
  target_link_libraries(spheroscope PRIVATE spheroscope_figures)
endif()

if(TARGET spheroscope_viewer)
  target_sources(spheroscope PRIVATE ${PROJECT_SOURCE_DIR}/viewer/verb_view.cpp)
  target_compile_definitions(spheroscope PRIVATE SPHEROSCOPE_HAS_VIEWER)
  target_link_libraries(spheroscope PRIVATE spheroscope_viewer)
endif()
