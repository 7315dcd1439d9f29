/** Text of a finite number with `digits` significant digits: plain where short, else with an exponent. */
export function significant(value: number, digits: number): string {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 10 ** (digits + 2) || size < 1e-3) return value.toExponential(digits - 1);
  const text = value.toPrecision(digits);
  return text.includes('e') ? String(Math.round(value)) : text;
}
