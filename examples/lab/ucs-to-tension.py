"""Map of UCS over direct tensile strength, as Markdown, from the results.csv of ucs-to-tension.toml."""
import collections
import csv
import statistics
import sys

strength = collections.defaultdict(dict)
modulus = collections.defaultdict(dict)
n_skipped = 0
with open(sys.argv[1], newline="") as file:
    for row in csv.DictReader(file):
        setting = (int(row["packing.n_grains"]), float(row["matrix.mu"]), float(row["matrix.tau_c [Pa]"]), row["packing"])
        kind = row["test.kind"]
        value = row["ucs [Pa]" if kind == "uniaxial" else "sigma_t [Pa]"]
        if row["status"] != "peaked" or not value:
            n_skipped += 1
            continue
        strength[setting][kind] = float(value)
        modulus[setting][kind] = float(row["E_small [Pa]"])

ratios, moduli, levels = collections.defaultdict(list), collections.defaultdict(list), collections.defaultdict(list)
for (n, mu, tau, packing), s in strength.items():
    if len(s) < 2:
        continue
    ratios[n, mu, tau].append(s["uniaxial"] / s["direct_tension"])
    levels[n, mu, tau].append((s["uniaxial"] / 50e6, s["direct_tension"] / 50e6))
    m = modulus[n, mu, tau, packing]
    moduli[n].append(m["direct_tension"] / m["uniaxial"])

taus = sorted({tau for _, _, tau in ratios})
for n in sorted({n for n, _, _ in ratios}):
    mean, sd = statistics.mean(moduli[n]), statistics.stdev(moduli[n])
    print(f"\n{n} grains; modulus in tension over that in compression {mean:.3f} +- {sd:.3f} (SD)\n")
    print("| mu | " + " | ".join(f"tau_c/sigma_c = {tau / 50e6:g}" for tau in taus) + " |")
    print("|---" * (len(taus) + 1) + "|")
    for mu in sorted({mu for _, mu, _ in ratios}):
        cells = []
        for tau in taus:
            r = ratios.get((n, mu, tau), [])
            cells.append(f"{statistics.mean(r):.2f} +- {statistics.stdev(r):.2f}" if len(r) > 1 else "-")
        print(f"| {mu:g} | " + " | ".join(cells) + " |")
best = max(ratios, key=lambda k: statistics.mean(ratios[k]))
least = min(ratios, key=lambda k: statistics.mean(ratios[k]))
for name, k in (("largest", best), ("smallest", least)):
    ucs = statistics.mean(v[0] for v in levels[k])
    tension = statistics.mean(v[1] for v in levels[k])
    print(f"\n{name}: {statistics.mean(ratios[k]):.2f} at {k[0]} grains, mu = {k[1]:g}, tau_c/sigma_c = {k[2] / 50e6:g}: "
          f"UCS/sigma_c = {ucs:.2f}, sigma_t/sigma_c = {tension:.2f}")
print(f"\n{n_skipped} tests without a peak left out")
