# Switches that the presets set, gathered in one interface target that every part of the project links.
set(LV_ARCH native CACHE STRING
    "Processors to build for: native (this one's kind only), or x86-64-v2, x86-64-v3, x86-64-v4, and all that know as much")
option(LV_WERROR "Warnings are errors" OFF)
option(LV_CHECKS "Keep the development checks (LV_ASSERT) at release speed" OFF)
set(LV_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined")
option(LV_COVERAGE "Instrument for gcov" OFF)

add_library(lv_options INTERFACE)
target_compile_options(lv_options INTERFACE
  -Wall -Wextra -Wpedantic -Wno-psabi
  # where a room is one unit, a local name may hide what a neighbour's unnamed namespace holds
  $<IF:$<BOOL:${CMAKE_UNITY_BUILD}>,-Wshadow=local,-Wshadow>
  # false alarms from GCC 12's own AVX-512 headers
  -Wno-uninitialized $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
  -fno-math-errno -fno-trapping-math  # sqrt needs no errno; NaN keeps its meaning
  # a room as one unit fits in the memory that GCC would tidy up again and again: a twentieth of the time
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
target_compile_options(lv_options INTERFACE -march=${LV_ARCH})
if(LV_WERROR)
  target_compile_options(lv_options INTERFACE -Werror)
endif()
if(LV_CHECKS)
  target_compile_options(lv_options INTERFACE -UNDEBUG)
endif()
if(LV_SANITIZE)
  # a finding ends the test that made it
  target_compile_options(lv_options INTERFACE -fsanitize=${LV_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(lv_options INTERFACE -fsanitize=${LV_SANITIZE})
endif()
if(LV_COVERAGE)
  target_compile_options(lv_options INTERFACE --coverage)
  target_link_options(lv_options INTERFACE --coverage)
endif()
find_program(LV_GOLD ld.gold)  # of the same package as ld, and links in a tenth of its time
if(LV_GOLD)
  target_link_options(lv_options INTERFACE -fuse-ld=gold)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")

# ITK contains copies of Eigen's functions compiled for other processors. None of ours may take their place when the
# program is loaded: memory of one would be freed by the other.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
