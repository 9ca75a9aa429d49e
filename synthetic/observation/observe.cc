#include "synthetic/observation/observe.h"
