/** @file calibration_text.h @brief A calibration's result for a reader. */
#ifndef HYPOFAB_DECK_CALIBRATION_TEXT_H
#define HYPOFAB_DECK_CALIBRATION_TEXT_H

#include "deck/calibration/calibration.h"

/** The report in words: calibration.md. To be freed; NULL when memory is short. */
char *calibration_text(const hypofab_calibration *c);

#endif
