/// Which page answers which address. Pages load when they are first opened.
import type { Component } from 'svelte';
import { matchPath } from './match';

export type PageProps = { params: Record<string, string> };
type Page = Component<PageProps>;

export interface Route {
  pattern: string;
  /** Entry of the left rail that is lit. */
  section: 'overview' | 'live' | 'runs' | 'campaigns' | 'scenarios' | 'papers' | 'about';
  load: () => Promise<{ default: Page }>;
}

export const routes: Route[] = [
  { pattern: '/', section: 'overview', load: () => import('../pages/overview/OverviewPage.svelte') },
  { pattern: '/live', section: 'live', load: () => import('../pages/live/LivePage.svelte') },
  { pattern: '/live/:id', section: 'live', load: () => import('../pages/live/LivePage.svelte') },
  { pattern: '/runs', section: 'runs', load: () => import('../pages/runs/RunsPage.svelte') },
  { pattern: '/runs/:id', section: 'runs', load: () => import('../pages/live/LivePage.svelte') },
  { pattern: '/compare', section: 'runs', load: () => import('../pages/compare/ComparePage.svelte') },
  { pattern: '/campaigns', section: 'campaigns', load: () => import('../pages/campaigns/CampaignsPage.svelte') },
  { pattern: '/campaigns/:id', section: 'campaigns', load: () => import('../pages/campaigns/CampaignPage.svelte') },
  { pattern: '/scenarios', section: 'scenarios', load: () => import('../pages/scenarios/ScenariosPage.svelte') },
  { pattern: '/scenarios/:id', section: 'scenarios', load: () => import('../pages/scenarios/ScenarioPage.svelte') },
  { pattern: '/system', section: 'scenarios', load: () => import('../pages/system/SystemPage.svelte') },
  { pattern: '/papers', section: 'papers', load: () => import('../pages/papers/PapersPage.svelte') },
  { pattern: '/papers/:source/:figure', section: 'papers', load: () => import('../pages/papers/PapersPage.svelte') },
  { pattern: '/methods', section: 'papers', load: () => import('../pages/methods/MethodsPage.svelte') },
  { pattern: '/methods/:id', section: 'papers', load: () => import('../pages/methods/MethodPage.svelte') },
  { pattern: '/about', section: 'about', load: () => import('../pages/about/AboutPage.svelte') },
];

export function findRoute(path: string): { route: Route; params: Record<string, string> } | null {
  for (const route of routes) {
    const params = matchPath(route.pattern, path);
    if (params) return { route, params };
  }
  return null;
}
