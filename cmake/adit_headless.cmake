# A program that draws scenes with no X server and no GPU: Mesa's software renderer serves every gl* call.
#
# OSMesa must come first among the program's libraries, before VTK's libGL, so that plain gl* calls bind to it; and the
# program must export the two functions at the end of render/gl_context_osmesa.cpp. Never for programs with a window.
function(adit_headless target)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:adit_osmesa>)
  target_link_options(${target} BEFORE PRIVATE -Wl,--no-as-needed ${OSMESA_LINK_LIBRARIES})
  set_target_properties(${target} PROPERTIES ENABLE_EXPORTS ON)
endfunction()

# The same for a program with Dear ImGui: its loader opens libGL by name (tests/ui/imgui_without_x.cpp).
function(adit_headless_imgui target)
  adit_headless(${target})
  target_link_options(${target} PRIVATE -Wl,--wrap=dlopen,--wrap=dlsym)
endfunction()
