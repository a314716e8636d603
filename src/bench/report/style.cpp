#include "bench/report/style.h"

namespace viete::bench {

namespace {

// A colour of the plots, and what it is on a dark ground.
constexpr const char* night[][2] = {{"#ffffff", "none"},    {"#1f2933", "#e3e7ec"}, {"#6b7785", "#9aa5b1"},
                                    {"#e4e8ec", "#2b333c"}, {"#cfd6dd", "#3b4651"}, {"#9aa5b1", "#6b7785"},
                                    {"#c77700", "#f0a13a"}, {"#0072b2", "#56b4e9"}, {"#009e73", "#3fc79a"},
                                    {"#b3589a", "#d98cc4"}, {"#3a3f9e", "#9499f0"}};

constexpr const char* by_day = R"(
:root{color-scheme:light;--paper:#fff;--ink:#1f2933;--faint:#5b6673;--rule:#e4e8ec;--wash:#f5f7f9;--ours:#0072b2}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--paper);color:var(--ink);font:1rem/1.6 system-ui,sans-serif}
header,main,footer{max-width:60rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:4rem}
h1{font-size:2.25rem;line-height:1.15;letter-spacing:-.02em;font-weight:650;margin:0 0 .75rem}
h2{font-size:1.5rem;line-height:1.25;letter-spacing:-.01em;font-weight:650;margin:0 0 .75rem}
h3{font-size:1rem;font-weight:650;margin:2rem 0 .5rem}
p{max-width:42rem;text-wrap:pretty;margin:0 0 1rem}
p.seen{font-size:1.125rem;line-height:1.55}
p.origin{font-size:.8125rem;color:var(--faint);margin:0 0 .25rem}
p.why,p.note{color:var(--faint)}
p.note{font-size:.875rem}
a{color:var(--ours);text-underline-offset:.15em;text-decoration-thickness:1px}
nav ol{list-style:none;padding:0;margin:2rem 0 0;display:flex;flex-wrap:wrap;gap:.25rem 1.5rem;font-size:.9375rem}
section{padding:3.5rem 0 0}
dl.glance{display:grid;grid-template-columns:repeat(auto-fit,minmax(11.5rem,1fr));gap:1.5rem 2rem;margin:2.5rem 0 0}
dl.glance div{display:flex;flex-direction:column-reverse;justify-content:flex-end;border-top:2px solid var(--ours);padding-top:.6rem}
dl.glance dt{font-size:.875rem;line-height:1.4;color:var(--faint)}
dl.glance dd{margin:0;font-size:1.875rem;line-height:1.2;font-weight:650;letter-spacing:-.02em;font-variant-numeric:tabular-nums}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,24rem),1fr));gap:2rem 3rem;margin:1.75rem 0}
figure{margin:0;max-width:30rem}
figcaption{font-size:.875rem;font-weight:600;margin:0 0 .75rem}
svg{display:block;width:100%;height:auto;font-family:inherit;font-variant-numeric:tabular-nums;overflow:visible}
.plots.small{grid-template-columns:repeat(auto-fit,minmax(9rem,1fr));gap:1.5rem 2rem}
.wide{overflow-x:auto;margin:1.5rem 0}
table{border-collapse:collapse;font-size:.875rem;line-height:1.4;font-variant-numeric:tabular-nums}
th,td{padding:.4rem 1.5rem .4rem 0;border-bottom:1px solid var(--rule);text-align:left;vertical-align:top}
th:last-child,td:last-child{padding-right:0}
thead th{font-weight:500;color:var(--faint);vertical-align:bottom}
tbody th{font-weight:600;white-space:nowrap}
th.n,td.n{text-align:right}
td.n{white-space:nowrap}
pre,code{font:.8125rem/1.5 ui-monospace,monospace}
pre{background:var(--wash);border-radius:.375rem;padding:.6rem .9rem;margin:0 0 .5rem;overflow-x:auto}
pre.command{white-space:pre-wrap;overflow-wrap:anywhere}
pre.command::before{content:"$ ";color:var(--faint)}
pre.raw{max-height:24rem;overflow:auto}
summary{cursor:pointer;color:var(--faint);font-size:.9375rem;margin:1rem 0}
footer{padding-top:3.5rem;padding-bottom:4rem}
@media(max-width:30rem){header{padding-top:2rem}h1{font-size:1.75rem}section{padding-top:2.5rem}th,td{padding-right:1rem}}
@media print{body{font-size:10pt}header{padding-top:0}nav,details.raw{display:none}section{padding-top:1.5rem}
.plots{grid-template-columns:1fr 1fr;gap:1rem 2rem}.wide{overflow:visible}figure,.wide,h2,h3,p.seen{break-inside:avoid}
h2,h3,p.origin,p.seen{break-after:avoid}dl.glance{grid-template-columns:repeat(4,1fr);gap:1rem}details .wide{break-inside:auto}pre{background:none;padding:0;white-space:pre-wrap}a{color:inherit;text-decoration:none}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)";

constexpr const char* colors_by_night =
    ":root{color-scheme:dark;--paper:#14181d;--ink:#e3e7ec;--faint:#9aa5b1;--rule:#2b333c;--wash:#1b2127;"
    "--ours:#56b4e9}\n";

}  // namespace

std::string page_style() {
  std::string text = by_day;
  text += "@media screen and (prefers-color-scheme:dark){";
  text += colors_by_night;
  for (const auto& [day, dark] : night) {
    for (const std::string property : {"fill", "stroke"})
      text += "svg [" + property + "=\"" + day + "\"]{" + property + ":" + dark + "}";
  }
  return text + "}\n";
}

}  // namespace viete::bench
