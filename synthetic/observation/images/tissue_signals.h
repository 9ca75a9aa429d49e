// How bright tissues are, urine = 1.
#pragma once

namespace pelvireg::observation
{
/// Relative signals of one kind of sequence. Fluids, fat, uterus, walls and levator: steady-state formula from
/// relaxation times for bSSFP, S = sin a / (1 + cos a + (1 - cos a) T1 / T2) at a = 60 degrees; TR 4000, TE 100 ms for
/// TSE (de Bazelaire 2004 and Takatsu 2015 for the times, walls as cervix and junctional zone). Bone, bowel, skin:
/// choices that look like the sequence.
struct TissueSignals
{
  double urine, gel, fat, myometrium, junctional_zone, endometrium, wall, muscle, marrow, cortical_bone, bowel, skin,
      spinal_fluid, urethra;
};

inline constexpr TissueSignals bssfp_signals = {.urine = 1,
                                                .gel = 0.97,
                                                .fat = 0.62,
                                                .myometrium = 0.43,
                                                .junctional_zone = 0.28,
                                                .endometrium = 0.49,
                                                .wall = 0.27,
                                                .muscle = 0.16,
                                                .marrow = 0.38,
                                                .cortical_bone = 0.04,
                                                .bowel = 0.40,
                                                .skin = 0.35,
                                                .spinal_fluid = 0.95,
                                                .urethra = 0.33};

inline constexpr TissueSignals tse_signals = {.urine = 1,
                                              .gel = 1,
                                              .fat = 0.70,
                                              .myometrium = 0.72,
                                              .junctional_zone = 0.38,
                                              .endometrium = 0.90,
                                              .wall = 0.28,
                                              .muscle = 0.07,
                                              .marrow = 0.40,
                                              .cortical_bone = 0.02,
                                              .bowel = 0.35,
                                              .skin = 0.30,
                                              .spinal_fluid = 1,
                                              .urethra = 0.40};
} // namespace pelvireg::observation
