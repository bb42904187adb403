#!/usr/bin/env python3
"""The scatter of docs/trade.md: estimates of runs against their true errors, from what bench/error_estimates prints.

    build/release/bench/error_estimates reference/images scenes/gallery/*.gl* | bench/error_scatter.py docs/error-estimates.svg

Both axes are logarithmic, from half a per cent to four hundred; scenes whose errors are below are left out. Lines: equal, and twice and half.
Nothing but Python's standard library is needed.
"""
import collections
import math
import pathlib
import re
import sys

LEFT, RIGHT, TOP, BOTTOM = 60.0, 620.0, 20.0, 590.0
LEAST, MOST = 0.005, 4.0
TICKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
COLOURS = ("#4e79a7", "#f28e2b", "#e15759", "#76b7b2", "#59a14f", "#edc948", "#b07aa1", "#ff9da7", "#9c755f",
           "#333333", "#d37295", "#499894", "#8c6d31", "#6b6ecf", "#637939")
LINE = re.compile(r"(\S+) .* estimate ([\d.]+) error ([\d.]+) ")


def share(value):
    return math.log(value / LEAST) / math.log(MOST / LEAST)


def x_of(value):
    return LEFT + (RIGHT - LEFT) * share(value)


def y_of(value):
    return BOTTOM - (BOTTOM - TOP) * share(value)


def line(factor, style):
    least, most = max(LEAST, LEAST / factor), min(MOST, MOST / factor)
    return (f'<path d="M{x_of(least):.1f} {y_of(least * factor):.1f}L{x_of(most):.1f} {y_of(most * factor):.1f}" '
            f'stroke="#888" {style}/>')


def scatter(points):
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 780 640" font-family="sans-serif" font-size="13">'
             '<rect width="100%" height="100%" fill="#fff"/>']
    for tick in TICKS:
        x, y = x_of(tick), y_of(tick)
        parts.append(f'<path d="M{x:.1f} {BOTTOM}V{TOP}M{LEFT} {y:.1f}H{RIGHT}" stroke="#e4e4e8"/>')
        parts.append(f'<text x="{x:.1f}" y="608" text-anchor="middle" fill="#555">{100 * tick:g} %</text>'
                     f'<text x="54" y="{y + 4:.1f}" text-anchor="end" fill="#555">{100 * tick:g} %</text>')
    parts += [line(1.0, ""), line(2.0, 'stroke-dasharray="4 4"'), line(0.5, 'stroke-dasharray="4 4"')]
    shown = {name: pairs for name, pairs in sorted(points.items()) if max(map(max, pairs)) > LEAST}
    for k, (name, pairs) in enumerate(shown.items()):
        colour = COLOURS[k % len(COLOURS)]
        parts += [f'<circle cx="{x_of(estimate):.1f}" cy="{y_of(error):.1f}" r="4.5" fill="{colour}" fill-opacity=".8"/>'
                  for estimate, error in pairs]
        y = 40 + 22 * k
        parts.append(f'<circle cx="642" cy="{y}" r="5" fill="{colour}"/><text x="652" y="{y + 4}">{name}</text>')
    parts.append('<text x="320.0" y="630" text-anchor="middle">estimate</text>'
                 '<text transform="translate(14 320.0) rotate(-90)" text-anchor="middle">error against the path tracer</text></svg>')
    return "\n".join(parts) + "\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    points = collections.defaultdict(list)
    for text in sys.stdin:
        if found := LINE.match(text):
            points[found[1]].append((float(found[2]), float(found[3])))
    pathlib.Path(sys.argv[1]).write_text(scatter(points), encoding="utf-8")


if __name__ == "__main__":
    main()
