// Colours of the scene and the plots, from the palette: they follow the light or dark scheme.

export function cssColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// The name of the colour of the line with this number: there are six, in turn.
export function lineColor(i) {
  return `c${i % 6}`;
}

export function onSchemeChange(listener) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener);
}
