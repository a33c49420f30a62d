// The address of what is open, so that it can be kept and sent, and Back leads back: ?rock=...&calibration=... beside the token.

export interface Place {
  rock: string;
  calibration: string; // its folder; "": the newest
}

const params = () => new URLSearchParams(location.search);

export function placeNow(): Place {
  return { rock: params().get("rock") ?? "", calibration: params().get("calibration") ?? "" };
}

const same = (a: Place, b: Place) => a.rock === b.rock && a.calibration === b.calibration;

function addressOf(to: Place): string {
  const all = params();
  for (const [key, value] of Object.entries(to)) value ? all.set(key, value) : all.delete(key);
  return `?${all}`;
}

/** Another place is another entry of the browser's history; `silent`: it takes the place of the one there. */
export function goTo(to: Place, silent = false) {
  if (same(to, placeNow())) return;
  history[silent ? "replaceState" : "pushState"](null, "", addressOf(to));
}

/** Back and forth. */
export const onReturn = (act: () => void) => addEventListener("popstate", act);
