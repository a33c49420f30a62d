// Quantities as they are printed.

/** Factor and unit in which a value is best read. */
export function readable(value: number, unit: string): [number, string] {
  if (unit === "1") return [1, ""];
  if (!unit.startsWith("Pa")) return [1, unit];
  return Math.abs(value) >= 1e9 ? [1e-9, `G${unit}`] : [1e-6, `M${unit}`];
}

export function friendly(value: number | null, unit: string): string {
  if (value === null || !Number.isFinite(value)) return "–";
  const [factor, name] = readable(value, unit);
  return `${(value * factor).toPrecision(4)}${name && ` ${name}`}`;
}
