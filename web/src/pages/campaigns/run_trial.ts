/// A trial alone, as the ordinary run of its seed.
import { campaigns } from '../../api/campaigns';
import { api } from '../../api/client';
import { navigate } from '../../router/router.svelte';

/** Starts it and goes to its page. Throws ApiProblem. */
export async function runTrial(campaign: string, index: number): Promise<void> {
  const { request } = await campaigns.trial(campaign, index);
  const started = await api.start({ ...request, pace: 'max' });
  navigate(`/live/${encodeURIComponent(started.id)}`);
}
