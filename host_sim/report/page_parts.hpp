#pragma once

namespace firmtouch::host_sim {

// report.css and viewer.js, put into the program by the build.
extern const char* const kReportCss;
extern const char* const kViewerJs;

}  // namespace firmtouch::host_sim
