#include "accuracy/report_assets.hpp"

namespace speculum {

// Blue, vermilion, green and grey are those of Okabe and Ito's palette, told apart by the colour-blind too; shapes and
// dashes say the same once more.
std::string_view reportStyle() {
  return R"css(
:root {
  color-scheme: light dark;
  --paper: #fdfdfb; --panel: #f4f3ef; --ink: #1d1e20; --soft: #5c5f63; --rule: #dcdad3; --faint: #ebe9e3;
  --front: #0072b2; --base: #c04e00; --truth: #007a5a; --dominated: #85888c; --theory: #c04e00;
  --selected: #fff3c9;
  --serif: Charter, "Bitstream Charter", "Sitka Text", Cambria, Georgia, serif;
  --sans: system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", "Liberation Sans", Arial, sans-serif;
  --mono: ui-monospace, SFMono-Regular, Menlo, Consolas, "Liberation Mono", "DejaVu Sans Mono", monospace;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    --paper: #141517; --panel: #1d1f22; --ink: #e5e3de; --soft: #a2a4a6; --rule: #3a3c40; --faint: #26282b;
    --front: #56b4e9; --base: #f0a04b; --truth: #3fc79a; --dominated: #85888d; --theory: #f0a04b;
    --selected: #3a3420;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body {
  margin: 0 auto; max-width: 76rem; padding: 2.5rem clamp(1rem, 4vw, 3rem) 4rem;
  background: var(--paper); color: var(--ink); font: 1.0625rem/1.55 var(--serif);
}
[hidden] { display: none !important; }
h1 { margin: 0.2rem 0 0; font-size: clamp(1.7rem, 5vw, 2.4rem); line-height: 1.15; font-weight: 600; }
h2 { margin: 3.2rem 0 0.6rem; font-size: 1.4rem; line-height: 1.25; font-weight: 600; }
h3 { margin: 0; font-size: 1.05rem; line-height: 1.3; font-weight: 600; }
p { margin: 0.5rem 0; max-width: 44rem; text-wrap: pretty; }
.kicker { margin: 0; font: 600 0.8rem/1.3 var(--sans); letter-spacing: 0.06em; text-transform: uppercase;
  color: var(--soft); }
.lede { margin-top: 1rem; font-size: 1.2rem; line-height: 1.5; max-width: 46rem; }
code, pre { font-family: var(--mono); font-size: 0.84em; }
code { overflow-wrap: anywhere; }
pre { margin: 0.6rem 0 1rem; padding: 0.8rem 1rem; background: var(--panel); border-radius: 4px; white-space: pre-wrap;
  overflow-wrap: anywhere; font-size: 0.8rem; line-height: 1.5; }
.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(13rem, 1fr)); gap: 0.7rem 1.6rem;
  margin: 1.8rem 0 0; padding: 1rem 0; border-block: 1px solid var(--rule); font: 0.86rem/1.4 var(--sans); }
.facts dt { color: var(--soft); font-size: 0.76rem; }
.facts dd { margin: 0; overflow-wrap: anywhere; }
dl.terms { display: grid; grid-template-columns: max-content minmax(0, 40rem); gap: 0.35rem 1.4rem; margin: 0.8rem 0; }
dl.terms dt { font-weight: 600; } dl.terms dd { margin: 0; }
details { margin: 0.8rem 0; } summary { cursor: pointer; font-family: var(--sans); font-size: 0.9rem; }

.figures { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 2rem 2.2rem; margin-top: 1.2rem; }
figure { margin: 0; min-width: 0; break-inside: avoid; } figure.main { grid-column: 1 / -1; }
figcaption p { margin: 0.1rem 0 0.5rem; color: var(--soft); font: 0.86rem/1.45 var(--sans); }
svg.plot { display: block; width: 100%; height: auto; font: 12px var(--sans); overflow: visible; }
.narrow { display: none; }
.plot .text { fill: var(--soft); } .plot .title { fill: var(--ink); } .plot .label { fill: var(--ink);
  paint-order: stroke; stroke: var(--paper); stroke-width: 3px; stroke-linejoin: round; }
.plot .middle { text-anchor: middle; } .plot .end { text-anchor: end; }
.plot .grid { stroke: var(--faint); stroke-width: 1; } .plot .grid.apart { stroke-dasharray: 1 3; stroke: var(--rule); }
.plot .axis { stroke: var(--soft); stroke-width: 1; }
.plot .shape { fill: currentColor; stroke: var(--paper); stroke-width: 1; }
.plot .front { color: var(--front); } .plot .dominated { color: var(--dominated); } .plot .base { color: var(--base); }
.plot .truth { color: var(--truth); } .plot .shape.hollow { fill: var(--paper); stroke: currentColor;
  stroke-width: 1.5; }
.plot .stroke { stroke: currentColor; fill: none; stroke-width: 1.6; }
.plot .front-line { color: var(--front); } .plot .front-line .stroke { stroke-width: 1.3; opacity: 0.7; }
.plot .floor { color: var(--soft); } .plot .floor .stroke { stroke-dasharray: 6 4; stroke-width: 1; }
.plot .fit { color: var(--front); } .plot .theory { color: var(--theory); }
.plot .theory .stroke { stroke-dasharray: 7 3 2 3; }
.plot .spread .bar { stroke: currentColor; stroke-width: 2.5; opacity: 0.55; }
.plot .spread .minimum { stroke: currentColor; stroke-width: 0.8; opacity: 0.8; }
.plot .hit { fill: transparent; stroke: none; }
.js .plot .mark[data-point] { cursor: pointer; }
.plot .mark:focus { outline: none; }
.plot .mark:hover .hit, .plot .mark:focus-visible .hit { stroke: var(--soft); stroke-width: 1.5; }
.plot .mark.selected .hit { stroke: var(--ink); stroke-width: 1.8; }
.tip { position: absolute; z-index: 5; max-width: min(24rem, 90vw); padding: 0.5rem 0.7rem; border-radius: 4px;
  background: var(--ink); color: var(--paper); font: 0.8rem/1.4 var(--sans); pointer-events: none;
  overflow-wrap: anywhere; white-space: pre-line; } .tip::first-line { font-weight: 600; }

.controls { display: flex; flex-wrap: wrap; align-items: center; gap: 0.6rem 1.2rem; max-width: none;
  font: 0.9rem/1.4 var(--sans); } .controls label { max-width: 100%; }
select, button { font: inherit; color: inherit; background: var(--panel); border: 1px solid var(--rule);
  border-radius: 4px; padding: 0.25rem 0.55rem; cursor: pointer; } select { max-width: 100%; }
button:hover, select:hover { border-color: var(--soft); }
:focus-visible { outline: 2px solid var(--front); outline-offset: 2px; }
.zoom button[aria-pressed=true] { background: var(--ink); color: var(--paper); }
.panes { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 1.2rem; margin-top: 0.8rem; }
.frame { --split: 50%; position: relative; overflow: hidden; background: var(--panel); border-radius: 3px; }
.frame img { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: contain; display: block;
  transform: scale(var(--zoom, 1)); transform-origin: var(--at-x, 50%) var(--at-y, 50%); }
.zoomed .frame img { image-rendering: pixelated; }
.frame .test { position: absolute; inset: 0; background: var(--panel);
  clip-path: inset(0 calc(100% - var(--split)) 0 0); }
.frame .divider { position: absolute; top: 0; bottom: 0; left: var(--split); width: 2px; margin-left: -1px;
  background: #fff; box-shadow: 0 0 0 1px rgb(0 0 0 / 0.45); pointer-events: none; }
.frame .divider::after { content: "‹ ›"; position: absolute; top: 50%; left: 50%; width: 2.1rem; height: 2.1rem;
  transform: translate(-50%, -50%); border-radius: 50%; background: #fff; color: #222; text-align: center;
  font: 600 1.05rem/1.95rem var(--sans); box-shadow: 0 0 0 1px rgb(0 0 0 / 0.45); }
.frame input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize;
  touch-action: pan-y; -webkit-appearance: none; appearance: none; }
.frame input::-webkit-slider-thumb { -webkit-appearance: none; width: 2px; height: 100%; }
.frame input::-moz-range-thumb { width: 2px; height: 100%; border: 0; }
.frame:has(input:focus-visible) { outline: 3px solid var(--front); outline-offset: 2px; }
.frame .side { position: absolute; top: 0.5rem; padding: 0.05rem 0.45rem; border-radius: 3px; pointer-events: none;
  background: rgb(0 0 0 / 0.62); color: #fff; font: 0.75rem/1.5 var(--sans); }
.side.left { left: 0.5rem; } .side.right { right: 0.5rem; }
.map { cursor: crosshair; } .legend { display: block; width: 100%; height: auto; }
.shown { font: 0.86rem/1.5 var(--sans); color: var(--soft); max-width: none; } .shown strong { color: var(--ink); }
.missing { padding: 1rem; color: var(--soft); font: 0.9rem/1.5 var(--sans); background: var(--panel); }
.test .missing, .map .missing { position: absolute; inset: 0; margin: 0; display: grid; place-content: center;
  text-align: center; overflow-wrap: anywhere; }

.scroll { overflow-x: auto; margin-top: 1rem; }
table { border-collapse: collapse; width: 100%; font: 0.77rem/1.4 var(--sans); font-variant-numeric: tabular-nums; }
caption { caption-side: top; text-align: left; color: var(--soft); padding-bottom: 0.5rem; font-size: 0.86rem; }
th, td { padding: 0.28rem 0.3rem; text-align: left; vertical-align: top; white-space: nowrap; font-weight: 400; }
thead th { font-weight: 600; vertical-align: bottom; } thead tr:last-child th { border-bottom: 1px solid var(--soft); }
.groups th { color: var(--soft); font-weight: 400; font-size: 0.76rem; padding-bottom: 0; }
tbody tr { border-bottom: 1px solid var(--faint); } tbody th { font-weight: 500; }
tbody tr.dominated { color: var(--soft); } tbody tr.selected { background: var(--selected); color: var(--ink); }
tfoot td, tfoot th { border-top: 1px solid var(--soft); color: var(--soft); }
.number, thead th:nth-child(n + 4) { text-align: right; } .groups th:nth-child(n + 3) { text-align: right; }
.mark { color: var(--front); text-align: center; } .quartiles { color: var(--soft); font-size: 0.92em; }
td.settings { white-space: normal; min-width: 14rem; } td.settings code { user-select: all; font-size: 0.7rem; }
td.settings code span { white-space: nowrap; } .none { color: var(--soft); font-style: italic; }
th button { border: 0; background: none; padding: 0; font-weight: inherit; text-align: inherit; white-space: nowrap; }
th button.name { text-decoration: underline; text-decoration-color: var(--rule); text-underline-offset: 0.2em; }
tr.base button.name { color: var(--base); }
th[aria-sort=ascending] button::after { content: " ↑"; } th[aria-sort=descending] button::after { content: " ↓"; }
abbr { text-decoration: none; } .copy { display: none; padding: 0 0.35rem; font-size: 0.72rem; color: var(--soft); }
.js .copy { display: inline-block; }
footer { margin-top: 3rem; padding-top: 0.8rem; border-top: 1px solid var(--rule); color: var(--soft);
  font: 0.82rem/1.5 var(--sans); }
html:not(.js) .controls, html:not(.js) .frame input { display: none; }

@media screen and (max-width: 46rem) {
  body { padding-top: 1.5rem; font-size: 1rem; } .lede { font-size: 1.1rem; }
  .figures, .panes { grid-template-columns: minmax(0, 1fr); } .wide { display: none; } .narrow { display: block; }
  dl.terms { grid-template-columns: minmax(0, 1fr); gap: 0; } dl.terms dd { margin-bottom: 0.5rem; }
  tbody th { position: sticky; left: 0; background: var(--paper); max-width: 9rem; white-space: normal; }
  tbody tr.selected th { background: var(--selected); } th button.name { white-space: normal; }
  .facts { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 0.6rem 1rem; }
}
@media print {
  @page { size: A4; margin: 14mm 12mm; }
  body { max-width: none; padding: 0; font-size: 10pt; background: #fff; } h2 { margin-top: 1.6rem; }
  h2, h3, figcaption { break-after: avoid; } tr, .panes { break-inside: avoid; }
  .controls, .copy, .js .copy, .tip, .hint { display: none; } .plot .mark.selected .hit { stroke: none; } .figures { gap: 1rem 1.4rem; } .scroll { overflow: visible; }
  table { font-size: 5.6pt; } th, td { padding: 0.12rem 0.2rem; } td.settings { min-width: 0; }
  td.settings code { font-size: 0.9em; } .groups th { font-size: inherit; } caption { font-size: 8pt; } tbody tr.selected { background: none; }
  .frame, .legend { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";
}

}  // namespace speculum
