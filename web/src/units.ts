// Quantities as they are printed.

/** Of each property: the factor from SI and its label. */
export const scales: Record<string, [number, string]> = { E: [1e-9, "E [GPa]"], nu: [1, "ν"], UCS: [1e-6, "UCS [MPa]"], DTS: [1e-6, "direct tensile strength [MPa]"], BTS: [1e-6, "Brazilian strength [MPa]"], sigma_1: [1e-6, "σ₁ at the peak [MPa]"], sigma_ci: [1e-6, "crack initiation σci [MPa]"], K_Ic: [1e-6, "fracture toughness K_Ic [MPa√m]"], I_s50: [1e-6, "point load strength I_s(50) [MPa]"] };

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
