# geovor_options(TARGET): what every target of the project is compiled with.
function(geovor_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # No contraction: a fused multiply-add on one machine and none on another would give other bytes.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -ffp-contract=off
                                           $<$<BOOL:${GEOVOR_WERROR}>:-Werror>)
  # GCC 12 sees overlapping copies in `"text" + std::string` where there are none (GCC bug 105651).
  target_compile_options(${target} PRIVATE $<$<AND:$<BOOL:${GEOVOR_WERROR}>,$<CXX_COMPILER_ID:GNU>>:-Wno-restrict>)
  if(GEOVOR_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${GEOVOR_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${GEOVOR_SANITIZE})
  endif()
endfunction()

# geovor_room(NAME SOURCES ... DEPENDS rooms...): one room of the library = one target geovor_NAME, exported as
# geovor::NAME. A room without sources is an interface target. DEPENDS are the rooms that it may include
# (docs/ARCHITECTURE.md).
function(geovor_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target geovor_${name})
  set(scope PUBLIC)
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    geovor_options(${target})
  else()
    add_library(${target} INTERFACE)
    target_compile_features(${target} INTERFACE cxx_std_20)
    set(scope INTERFACE)
  endif()
  add_library(geovor::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/geovor>)
  list(TRANSFORM ROOM_DEPENDS PREPEND geovor::)
  target_link_libraries(${target} ${scope} ${ROOM_DEPENDS})
  set_property(GLOBAL APPEND PROPERTY GEOVOR_ROOMS ${target})
endfunction()
