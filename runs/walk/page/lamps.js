// Lamps apart: H = sum over lamps l of s_l H_l at the vertices, s_l a factor by channel, and what is seen
// of the lamps themselves, which follows the same factors (scenes/lamps.h).
//
// While one lamp is dimmed the sum of all others is kept, so that a step costs one lamp's light, and every
// sum is made anew from the halves of the file: nothing adds up from step to step.
"use strict";

/// The numbers of halves 0 to 65504, by their bits.
const halfNumbers = halvesToNumbers(new Uint16Array(31 << 10).map((_, bits) => bits));

/// sum + factor times the light of a lamp, in place; `scale` is W/m^2 of a unit of the sum.
function addLamp(sum, { halves, light }, factor, scale) {
  const [r, g, b] = times(factor, light / scale);
  if (r === 0 && g === 0 && b === 0) return sum;
  for (let k = 0; k < sum.length; k += 3) {
    sum[k] += r * halfNumbers[halves[k]];
    sum[k + 1] += g * halfNumbers[halves[k + 1]];
    sum[k + 2] += b * halfNumbers[halves[k + 2]];
  }
  return sum;
}

const isWhole = factor => factor.every(s => s === 1);

/// A number as the command line takes it; NaN of anything else.
const plainNumber = text => /^\s*(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*$/i.test(text) ? Number(text) : NaN;

/// Lamps with their factors, and the room under them. `state` counts the changes.
function makeLamps(data, tables) {
  const lamps = data.lamps.map((lamp, number) => ({ name: lamp.name, start: lamp.factor, factor: lamp.factor, light: lamp.light,
    halves: tables["lamp" + number] }));
  data.lamps.forEach((_, number) => { delete tables["lamp" + number]; });
  for (const look of data.looks) look.whole = look.emission;
  const length = tables.irradiance.length, allOfThem = halvesToNumbers(tables.irradiance);
  const apart = lamps.length ? new Float32Array(length) : null;
  let alone = null, others = null, sum = allOfThem, shown = lamps.map(() => [1, 1, 1]);

  function sumOfOthers(lamp) {
    const rest = new Float32Array(length);
    lamps.forEach(other => { if (other !== lamp) addLamp(rest, other, other.factor, data.light); });
    return rest;
  }
  /// The light at the vertices in units of data.light, made anew where factors have changed.
  function irradiance() {
    const changed = lamps.filter((lamp, k) => lamp.factor !== shown[k]);
    if (!changed.length) return sum;
    shown = lamps.map(lamp => lamp.factor);
    if (lamps.every(lamp => isWhole(lamp.factor))) {
      alone = null;
      return sum = allOfThem;
    }
    if (changed.length > 1 || changed[0] !== alone) {
      alone = changed[changed.length - 1];
      others = sumOfOthers(alone);
    }
    apart.set(others);
    return sum = addLamp(apart, alone, alone.factor, data.light);
  }
  const all = { lamps, state: 0, irradiance,
    of: number => number < 0 ? [1, 1, 1] : lamps[number].factor,
    /// Emission of looks; returns them.
    looks() {
      for (const look of data.looks) { const s = all.of(look.lamp); look.emission = look.whole.map((x, k) => x * s[k]); }
      return data.looks;
    },
    set(lamp, factor) { lamp.factor = factor; ++all.state; },
    /// What a link or the command line says: NAME=FACTOR or NAME=R,G,B, `all` for all; the last word counts.
    take(texts) {
      for (const text of texts) {
        const at = text.lastIndexOf("="), name = text.slice(0, at), numbers = text.slice(at + 1).split(",").map(plainNumber);
        if (at < 1 || ![1, 3].includes(numbers.length) || !numbers.every(s => s >= 0 && s <= 1e6)) continue;
        const factor = numbers.length === 3 ? numbers : [0, 1, 2].map(() => numbers[0]), named = lamps.filter(lamp => lamp.name === name);
        for (const lamp of named.length ? named : name === "all" ? lamps : []) all.set(lamp, factor);
      }
    },
    /// Other light of the whole room, by vertex, in units of data.light; no lamp is known apart.
    receive(values) { allOfThem.set(values); ++all.state; },
    reset() { for (const lamp of lamps) all.set(lamp, lamp.start); }
  };
  return all;
}

/// A factor as the command line takes it.
function factorText(factor) {
  const numbers = factor.map(s => String(Number(s.toPrecision(4))));
  return numbers.every(s => s === numbers[0]) ? numbers[0] : numbers.join(",");
}
/// The options of `render` that make the same light: lamps that are as the file has them are left out.
function lampOptions(lamps) {
  const quoted = text => "'" + text.replaceAll("'", "'\\''") + "'";
  return lamps.filter(lamp => !isWhole(lamp.factor)).map(lamp => "--lamp " + quoted(`${lamp.name}=${factorText(lamp.factor)}`)).join(" ");
}
