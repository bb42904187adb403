// The card with a dimmer and a colour for each lamp. A factor is the dimmer's share times a colour whose
// brightest channel is 1; steps are quarters of a stop, from off to eight times.
"use strict";

const stepOfOne = 28, lastStep = 40;
const shareOfStep = step => step <= 0 ? 0 : 2 ** ((step - stepOfOne) / 4);
const stepOfShare = share => share > 0 ? clamped(Math.round(stepOfOne + 4 * Math.log2(share)), 1, lastStep) : 0;

const decoded = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
const encoded = x => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
/// As inputs of colours have it, #rrggbb.
const hexOf = colour => "#" + colour.map(x => Math.round(255 * encoded(clamped(x, 0, 1))).toString(16).padStart(2, "0")).join("");
/// Its brightest channel is 1; black is white.
function colourOf(hex) {
  const colour = [1, 3, 5].map(k => decoded(parseInt(hex.slice(k, k + 2), 16) / 255)), most = Math.max(...colour);
  return most > 0 ? times(colour, 1 / most) : [1, 1, 1];
}
const shareText = share => share > 0 ? `${Number((100 * share).toPrecision(3))} %` : "off";

function madeElement(tag, attributes, text = "") {
  const made = Object.assign(document.createElement(tag), attributes);
  made.textContent = text;
  return made;
}

/// One lamp's row; `changed` is called when somebody has moved it. Returns what shows its factor anew.
function makeDimmer(lamp, number, lamps, list, changed) {
  const id = "dimmer" + number, label = madeElement("label", { htmlFor: id, title: lamp.name }, lamp.name || "lamp " + (number + 1));
  const slider = madeElement("input", { id, type: "range", min: 0, max: lastStep, step: 1 }), says = madeElement("output", { htmlFor: id });
  const colour = madeElement("input", { type: "color", title: "colour, beside that of the lamp" });
  colour.setAttribute("aria-label", "colour of " + label.textContent);
  let tint = [1, 1, 1];
  slider.addEventListener("input", () => { lamps.set(lamp, times(tint, shareOfStep(Number(slider.value)))); changed(); });
  colour.addEventListener("input", () => { tint = colourOf(colour.value); lamps.set(lamp, times(tint, Math.max(...lamp.factor))); changed(); });
  list.append(label, says, slider, colour);
  return () => {
    const share = Math.max(...lamp.factor);
    if (share > 0) tint = times(lamp.factor, 1 / share);
    says.textContent = shareText(share);
    if (shareOfStep(Number(slider.value)) !== share) slider.value = stepOfShare(share);
    slider.setAttribute("aria-valuetext", says.textContent);
    if (document.activeElement !== colour) colour.value = hexOf(tint);
  };
}

/// Returns { show, toggle }. `changed` asks for a frame.
function makeDimmers(lamps, changed) {
  const card = element("lamps"), button = element("lamps-button"), list = element("dimmers"), command = element("command");
  let shown = -1;
  const show = () => {
    if (shown === lamps.state) return;
    shown = lamps.state;
    shows.forEach(showFactor => showFactor());
    command.textContent = lampOptions(lamps.lamps);
    element("copy").hidden = !command.textContent;
  };
  const moved = () => { show(); changed(); };
  const shows = lamps.lamps.map((lamp, number) => makeDimmer(lamp, number, lamps, list, moved));
  button.hidden = !shows.length;
  card.hidden = !shows.length || innerWidth < 700;
  element("reset").addEventListener("click", () => { lamps.reset(); moved(); });
  element("copy").addEventListener("click", async () => {
    try { await navigator.clipboard.writeText(command.textContent); }
    catch { getSelection().selectAllChildren(command); } // then the keys of the browser copy it
  });
  card.addEventListener("keydown", event => { if (event.key === "Escape") element("view").focus(); });
  return {
    toggle() { card.hidden = !card.hidden || !shows.length; },
    show() { button.setAttribute("aria-pressed", !card.hidden); show(); }
  };
}
