/** The panel that tells whether the attack can be identified, as other panels lead to it. */
export const verdictId = 'identifiability';

export function showVerdict(): void {
  const panel = document.getElementById(verdictId);
  panel?.scrollIntoView({ block: 'center' });
  panel?.focus({ preventScroll: true });
}
