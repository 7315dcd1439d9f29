/// Short messages below the header: what was done, what failed.
export interface Notice {
  id: number;
  text: string;
  tone: 'plain' | 'bad';
  action?: { word: string; run: () => void };
}

let list = $state.raw<Notice[]>([]);
let next = 1;

export const notices = {
  get list(): readonly Notice[] {
    return list;
  },
  dismiss(id: number): void {
    list = list.filter((notice) => notice.id !== id);
  },
};

/** Shows a message for ten seconds, or until dismissed. */
export function notify(text: string, tone: Notice['tone'] = 'plain', action?: Notice['action']): void {
  const id = next++;
  list = [...list.slice(-3), { id, text, tone, action }];
  setTimeout(() => notices.dismiss(id), 10_000);
}
