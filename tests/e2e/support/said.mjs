// What the page says, once it says it: a text is there before its numbers are.
import { until } from './server.mjs';

const once = (read) => async (place, pattern) => {
  let text = '';
  return until(`${pattern} is said`, async () => {
    text = (await read(place)) ?? '';
    return pattern.exec(text);
  }).catch((error) => {
    throw new Error(`${error.message}; it said: ${text}`);
  });
};

/**
 * Waits until a place's text matches and answers the match. The pattern must want digits where a number is to be (`number`),
 * since a sign stands there until the value has come.
 */
export const said = once((place) => place.innerText());
/** The same of a picture's label. */
export const labelled = once((place) => place.getAttribute('aria-label'));
/** Waits until there are n of them. */
export const counted = (places, n) => until(`${n} of ${places}`, async () => (await places.count()) === n);

/** A number as the page writes it, for a pattern. */
export const number = String.raw`(-?\d[\d.]*(?:e[-+]?\d+)?)`;
