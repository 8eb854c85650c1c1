// Colours of the scene and the plots, from the style sheet: they follow the light or dark scheme.

export function cssColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export const SERIES = ['c0', 'c1', 'c2', 'c3', 'c4', 'c5'];

export function onSchemeChange(listener) {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', listener);
}
