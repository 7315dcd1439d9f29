import { api } from '../../api/client';
import { ApiProblem } from '../../api/problem';
import type { RunDetail } from '../../api/types';
import type { Schema } from '../../form/schema';

/** The schema of a run's scenario; of any scenario where the run's own document was never saved under its id. */
export async function schemaFor(run: RunDetail): Promise<Schema> {
  try {
    return (await api.schema(run.scenario)) as Schema;
  } catch (error) {
    if (!(error instanceof ApiProblem) || error.status !== 404) throw error;
    const first = (await api.scenarios()).items[0];
    if (!first) throw error;
    return (await api.schema(first.id)) as Schema;
  }
}
