# Every library the project links, found once. Layers link what they need, privately.

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(Ceres REQUIRED)
find_package(OpenMesh REQUIRED)
find_package(CGAL REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-pdf cairo-svg pangocairo)
pkg_check_modules(OSMESA REQUIRED IMPORTED_TARGET osmesa)
pkg_check_modules(CLIPPER REQUIRED IMPORTED_TARGET polyclipping)
find_library(DXFLIB dxflib REQUIRED)
find_library(ISAL isal REQUIRED)  # checksums of E57 pages

# PCL's package looks for a VTK with Qt and MPI, and for cameras; none of that is ours.
foreach(unwanted VTK OpenNI OpenNI2 Pcap)
  set(CMAKE_DISABLE_FIND_PACKAGE_${unwanted} ON)
endforeach()
find_package(PCL 1.13 REQUIRED COMPONENTS common io registration filters search kdtree)
foreach(unwanted VTK OpenNI OpenNI2 Pcap)
  set(CMAKE_DISABLE_FIND_PACKAGE_${unwanted} OFF)
endforeach()
# One target for PCL: its headers as system headers, only the libraries named.
add_library(adit_pcl INTERFACE)
target_include_directories(adit_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(adit_pcl INTERFACE ${PCL_LIBRARIES})

find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel RenderingCore RenderingOpenGL2 RenderingFreeType
                                         FiltersCore FiltersSources)

# OpenCV: the parts that are used, without its own package file, which asks for all of it.
add_library(adit_opencv INTERFACE)
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
target_include_directories(adit_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module core imgproc imgcodecs features2d calib3d)
  find_library(OPENCV_${module} opencv_${module} REQUIRED)
  target_link_libraries(adit_opencv INTERFACE ${OPENCV_${module}})
endforeach()

find_package(JPEG REQUIRED)

# E57 and LAZ: packages of the system, or what packaging/scan_libraries has put into its prefix. The build works without.
if(DEFINED ENV{ADIT_PREFIX})
  set(adit_prefix $ENV{ADIT_PREFIX})
else()
  set(adit_prefix /opt/adit)
endif()
find_library(E57FORMAT_LIBRARY E57Format HINTS ${adit_prefix}/lib)
find_path(E57FORMAT_INCLUDE_DIR E57Format.h HINTS ${adit_prefix}/include PATH_SUFFIXES E57Format)
find_package(XercesC)  # libE57Format reads its XML with it
if(ADIT_E57 AND E57FORMAT_LIBRARY AND E57FORMAT_INCLUDE_DIR AND XercesC_FOUND)
  add_library(adit_e57format INTERFACE)
  target_include_directories(adit_e57format SYSTEM INTERFACE ${E57FORMAT_INCLUDE_DIR})
  target_link_libraries(adit_e57format INTERFACE ${E57FORMAT_LIBRARY} XercesC::XercesC)
else()
  message(STATUS "E57 is left out: packaging/setup brings its library")
endif()
find_library(LASZIP_LIBRARY laszip HINTS ${adit_prefix}/lib)
find_path(LASZIP_INCLUDE_DIR laszip/laszip_api.h HINTS ${adit_prefix}/include)
if(ADIT_LAZ AND LASZIP_LIBRARY AND LASZIP_INCLUDE_DIR)
  add_library(adit_laszip INTERFACE)
  target_include_directories(adit_laszip SYSTEM INTERFACE ${LASZIP_INCLUDE_DIR})
  target_link_libraries(adit_laszip INTERFACE ${LASZIP_LIBRARY})
else()
  message(STATUS "LAZ is left out: packaging/setup brings its library")
endif()

if(ADIT_GUI)
  find_package(glfw3 3.3 REQUIRED)
  find_package(OpenGL REQUIRED)
  # Debian's Dear ImGui: the backends for GLFW and OpenGL 3 are inside; its headers want both roots.
  find_library(IMGUI_LIBRARY imgui REQUIRED)
  find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
  find_library(STB_LIBRARY stb REQUIRED)
  add_library(adit_imgui INTERFACE)
  target_include_directories(adit_imgui SYSTEM INTERFACE ${IMGUI_INCLUDE_DIR})
  target_link_libraries(adit_imgui INTERFACE ${IMGUI_LIBRARY} ${STB_LIBRARY} ${CMAKE_DL_LIBS})
endif()
