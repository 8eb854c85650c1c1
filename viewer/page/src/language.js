// A browser takes its language from the system, and may name one that Intl refuses, such as en-US@posix. The library
// of the plots would throw while it loads. This module must be imported before it.
try {
  Intl.getCanonicalLocales(navigator.language);
} catch {
  Object.defineProperty(navigator, 'language', { value: 'en-US' });
}
