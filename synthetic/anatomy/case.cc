#include "synthetic/anatomy/case.h"
