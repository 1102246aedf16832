#include "io/scan_formats.h"
