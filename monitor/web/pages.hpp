#pragma once
/// The files of the page, compiled in; pages.cpp.in is filled when CMake runs.

namespace fsi::monitor {

extern const char* const page_html;
extern const char* const page_css;
extern const char* const page_js;
extern const char* const plots_js;
extern const char* const raster_js;
extern const char* const picture_js;

}  // namespace fsi::monitor
