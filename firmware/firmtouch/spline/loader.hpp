#pragma once
#include "firmtouch/spline/guide/loader.hpp"
#include "firmtouch/spline/surface/loader.hpp"
