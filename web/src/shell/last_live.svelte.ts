/// Where "Live" in the rail leads: the run looked at last, else the demo.
let run = $state<string | null>(null);

export const lastLive = {
  get run(): string | null {
    return run;
  },
  set(id: string | null): void {
    run = id;
  },
};
