#include "reference_fe/reference.h"
