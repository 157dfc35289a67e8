#include "report/style.hpp"

#include "show/palette.hpp"

namespace ballflow::report {

std::string style_sheet() {
  std::string css = R"css(
:root { color-scheme: light dark; --ground: #fff; --ink: #1c2026; --soft: #5c6470; --line: #d9dde3; --panel: #f6f7f9; --bad: #b3261e; --warn: #c98a00; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16191d; --ink: #e6e9ee; --soft: #9aa3af; --line: #343a42; --panel: #1e2227; --bad: #ff8a80; --warn: #e5b64a; }
}
body { margin: 0 auto; max-width: 76rem; padding: 2rem 1.5rem 4rem; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 1.1rem; margin: 2.2rem 0 .6rem; border-bottom: 1px solid var(--line); padding-bottom: .3rem; }
header p, small, figcaption, summary { color: var(--soft); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; margin: .5rem 0; }
th, td { padding: .25rem .9rem .25rem 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--soft); white-space: nowrap; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
pre { background: var(--panel); padding: .8rem 1rem; border-radius: 6px; overflow-x: auto; font-size: .85rem; }
figure { display: inline-block; vertical-align: top; width: 36rem; max-width: 100%; margin: .6rem 1rem 1rem 0; }
figure.picture { display: block; width: auto; margin: .6rem 0 1.6rem; }
figcaption { font-size: .9rem; margin-bottom: .3rem; }
img { width: 100%; height: auto; border: 1px solid var(--line); border-radius: 6px; background: #fff; }
.plot { width: 100%; height: auto; font-size: 12px; }
.plot text { fill: var(--soft); }
.plot .grid { stroke: var(--line); }
.plot .axis { stroke: var(--soft); }
.plot polyline { fill: none; stroke: var(--c); stroke-width: var(--w, 2); }
.plot .guide, .key .guide { fill: none; stroke: var(--soft); stroke-width: 1.5; stroke-dasharray: 5 4; }
.plot .whisker { stroke: var(--c); stroke-width: 1.5; }
.plot .band { fill: var(--c); opacity: .18; }
.plot circle, .plot rect, .plot path, .key circle, .key rect, .key path { fill: var(--c); }
.legend { font-size: .85rem; margin: .2rem 0 0; }
.legend span { margin-right: 1.2rem; white-space: nowrap; }
.key { width: .85rem; height: .85rem; margin-right: .35rem; vertical-align: -.1rem; }
.error { color: var(--bad); }
details { margin: .6rem 0; }
.facts { list-style: none; margin: .8rem 0 0; padding: .7rem 1rem; background: var(--panel); border-radius: 6px; font-size: 1.05rem; font-weight: 600; }
.troubles { list-style: none; padding: 0; }
.troubles li { margin: .5rem 0; padding: .5rem .9rem; border-left: 4px solid var(--warn); background: var(--panel);
  border-radius: 0 6px 6px 0; overflow-wrap: anywhere; }
.troubles li.error { border-color: var(--bad); }
.cards { columns: 21rem; column-gap: 1rem; }
article { break-inside: avoid; margin-bottom: 1rem; border: 1px solid var(--line); border-radius: 6px; padding: .7rem 1rem; min-width: 0; }
article h3 { margin: 0; font-size: 1rem; overflow-wrap: anywhere; }
article h3 small { font-weight: 400; }
article p { margin: .3rem 0; }
article table { width: 100%; }
article th { font-weight: 400; }
article td { overflow-wrap: anywhere; padding-right: 0; }
article td.number { white-space: normal; }
article tr:last-child th, article tr:last-child td { border-bottom: 0; }
.export { color: var(--soft); font-size: .8rem; }
@media print { details > * { display: block; } }
)css";
  for (std::size_t i = 0; i < 8; ++i) {
    css += ".s" + std::to_string(i) + " { --c: " + show::hex(show::category(i)) + "; }\n";
  }
  return css;
}

}  // namespace ballflow::report
