#include "synthetic/dataset/anatomy.h"
