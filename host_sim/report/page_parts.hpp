#pragma once

namespace firmtouch::host_sim {

// Style sheets and scripts of the pages, embedded by the build.
extern const char* const kReportCss;
extern const char* const kReportJs;
extern const char* const kViewJs;
extern const char* const kLiveHtml;
extern const char* const kLiveCss;
extern const char* const kLiveJs;

}  // namespace firmtouch::host_sim
