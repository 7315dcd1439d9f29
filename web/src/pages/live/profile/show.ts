/// The card that says in words what a lane does, as other panels lead to it.
export const profileId = 'profile';

export function showProfile(): void {
  const panel = document.getElementById(profileId);
  panel?.scrollIntoView({ block: 'center' });
  panel?.focus({ preventScroll: true });
}
