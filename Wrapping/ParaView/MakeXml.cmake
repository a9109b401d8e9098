# The program that fills the parameters into the plugin's XML, which the plugin is built by and tests check.
add_executable(MakeXml "${CMAKE_CURRENT_LIST_DIR}/Plugin/MakeXml.cxx")
target_link_libraries(MakeXml PRIVATE FlipFreeKernels FlipFreeWarnings)
