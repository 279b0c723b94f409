// SPDX-License-Identifier: Apache-2.0
// The terms of the report in plain words.

const glossary = [
  ['Indication', 'What the probe reads: X_M at a spindle angle C and a height Z. Inside this report X is a radius, never a diameter.'],
  ['Association', 'Fitting an ideal cone, cylinder or plane to the readings. The result is the associated surface; its axis is the datum axis.'],
  ['Residual', 'Measured minus model, along the probe. It contains form deviation, spindle motion and noise.'],
  ['Coaxiality', 'A diameter (ISO 1101): twice the largest distance between the axis of the cut surface and the datum axis over the toleranced length.'],
  ['Standard uncertainty u, expanded uncertainty U', 'u is the standard deviation of the value\'s possible error (GUM). U = k u; with k = 2 about 95 % of cases lie within ± U.'],
  ['Type A, type B', 'A comes from the scatter of the readings, B from other knowledge: a datasheet, a calibration, a setting.'],
  ['Not determined', 'The readings leave this number open, so none is given. More readings, another section or a longer arc would fix it.'],
  ['Remainder', 'With several references one axis cannot suit all. The remainder is the deviation that stays at each one.'],
  ['Part frame', 'Turns with the part: x = X cos C, y = X sin C for a probe at the height of the spindle axis, z = Z. The x and y of an axis are in it.'],
  ['Sense of C', 'C grows in the sense that the control shows as positive; sections and directions count the same way from +x.'],
  ['X_fts, command', 'X commanded minus X programmed, positive away from the spindle axis. The command is X_fts sent ahead of time, so that the actuator, which lags, arrives at the wanted place.'],
  ['Following error', 'The largest distance between where the tool is and where it is wanted, predicted from the actuator\'s response.'],
  ['Go, no-go', 'Decided with the uncertainty on the side of caution (ISO 14253-1): the upper bound of the coaxiality (95 % confidence) must lie within the tolerance. Not proven: neither that nor the contrary is shown, and the line says what would show it. With reservations: within the tolerance whichever model is right, but the data leave the model open. A slip in the chuck is a no-go, and so are causes that do not reproduce the readings.'],
  ['Roundness', 'Peak to valley of the trace about its least-squares circle, without a filter (ISO 12181: LSCI). Undulations per revolution: 2 is an oval, 3 the lobes of a three-jaw chuck.'],
  ['Cause, rival causes', 'A cause is listed if noise alone would rarely show it. If rival causes fit the readings equally well, all are listed with their probabilities.'],
  ['Cross-validated RMS', 'The residuals in blocks of readings that the model was not fitted to. Only a correct model predicts such readings.'],
  ['Cosmetic', 'A cause that explains readings but does not move the axis: correcting for it does not make the part truer.'],
];

const glossaryFold = () => fold('terms', 'Terms and conventions', facts(glossary, 'terms'));
