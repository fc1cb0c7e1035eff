# With CMAKE_UNITY_BUILD (the release presets) the sources of a room are compiled as one: what their headers cost is paid once a room, not once
# a file. So a name in an unnamed namespace stands once in its room. The daily build (preset "dev") compiles file by file, for a change
# costs least there, and finds a source that leans on its neighbour's includes.
function(lv_one_unit_per_room target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(room "${folder}" NAME)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${room}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()
