#pragma once

namespace firmtouch::host_sim {

// Contents of report.css and viewer.js, embedded by the build.
extern const char* const kReportCss;
extern const char* const kViewerJs;

}  // namespace firmtouch::host_sim
