"""What was expected of measured rocks before any test, beside what came of it: data/rocks/forecasts.csv, which the program holds."""
import json

HEAD = ("# What was expected of measured rocks before any test, and what came of it on unseen packings (rms; nu absolute). "
        "Written by `make rocks`.\nrock,first packing,effort,property,low,high,reached\n")


def rows_of(name, seed, found):
    """A row for each property that the calibration's own forecast has a range of."""
    forecast = next((f for f in found.get("reach", []) if f["kind"].startswith("forecast_")), None)
    reached = next((e for e in found["errors"] if "unseen packings" in e["of"]), {})
    ranges = forecast["numbers"].items() if forecast else []
    return [(name, seed, found.get("effort", "elastic"), p, f"{low:.4f}", f"{high:.4f}", f"{reached[p]:.4f}")
            for p, (low, high) in ranges if reached.get(p) is not None]


def write(path, runs):
    """`runs`: by rock. Rocks that were not asked for keep their rows."""
    rows = [r for name, some in runs.items() for run in some if run.result.suffix == ".json" and run.result.exists()
            for r in rows_of(name, run.seed, json.loads(run.result.read_text(encoding="utf-8")))]
    done = {r[0] for r in rows}
    if path.exists():
        kept = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()[2:]]
        rows += [tuple(r) for r in kept if r[0] not in done]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEAD + "".join(",".join(map(str, r)) + "\n" for r in sorted(rows, key=lambda r: (r[0], int(r[1]), r[3]))),
                    encoding="utf-8")
